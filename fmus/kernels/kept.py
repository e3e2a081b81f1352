"""Compiled kernels on disk: each file with its digest, written by one process at a time.

numba's own files are taken as they are, so that a damaged one ends every later process; and two processes
that keep unlike signatures of one function at once can each write the file to which the other's index points.
"""

from __future__ import annotations

import hashlib
import pickle
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from numba.core.caching import IndexDataCacheFile

try:
    import fcntl
except ImportError:  # Windows: without a lock, as numba does
    fcntl = None  # type: ignore[assignment]

_DIGEST = hashlib.sha256().digest_size


class KeptFile(IndexDataCacheFile):
    """Index and data of the compiled code of one function; otherwise as numba's."""

    def save(self, key: Any, data: Any) -> None:
        """Save an entry; other processes wait."""
        with _alone(Path(self._cache_path)):
            super().save(key, data)

    def _load_index(self) -> dict[Any, str]:
        content = _read(self._index_path)
        if content is None:
            return {}
        version, stamp, overloads = pickle.loads(content)
        if (version, stamp) != (self._version, self._source_stamp):
            return {}
        return dict(pickle.loads(overloads))

    def _save_index(self, overloads: dict[Any, str]) -> None:
        content = pickle.dumps((self._version, self._source_stamp, self._dump(overloads)))
        self._write(self._index_path, content)

    def _load_data(self, name: str) -> Any:
        content = _read(self._data_path(name))
        if content is None:
            raise FileNotFoundError(name)  # which the caller takes for a kernel that is not kept
        return pickle.loads(content)

    def _save_data(self, name: str, data: Any) -> None:
        self._write(self._data_path(name), self._dump(data))

    def _write(self, path: str, content: bytes) -> None:
        with self._open_for_write(path) as file:
            file.write(hashlib.sha256(content).digest() + content)


def _read(path: str) -> bytes | None:
    """Return the content of a file; None if there is none, or it is not as it was written."""
    try:
        kept = Path(path).read_bytes()
    except OSError:
        return None
    content = kept[_DIGEST:]
    return content if hashlib.sha256(content).digest() == kept[:_DIGEST] else None


def keep_safely(dispatcher: Any, stamp: str) -> Any:
    """Let a compiled function be kept in a `KeptFile` of that stamp, and return its cache.

    A disk that is full does not matter: compiled it is all the same.
    """
    cache = dispatcher._cache
    cache._cache_file = KeptFile(cache.cache_path, cache._impl.filename_base, stamp)
    save = cache.save_overload

    def save_if_possible(*arguments: Any) -> None:
        with suppress(OSError):
            save(*arguments)

    cache.save_overload = save_if_possible
    return cache


@contextmanager
def _alone(folder: Path) -> Iterator[None]:
    """Keep other processes away from a folder, as far as the system can."""
    if fcntl is None:
        yield
        return
    with (folder / "kernels.lock").open("a") as file:
        with suppress(OSError):  # a file system without locks
            fcntl.flock(file, fcntl.LOCK_EX)
        yield
