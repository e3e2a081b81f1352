"""A run in the face of units that change its process, or end it: their code runs in it with all rights."""

from __future__ import annotations

import atexit
import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import NoReturn

from orchestrator.outcome import PROCESS_DIED
from orchestrator.results.replacing import umask

_leave = os._exit
_LAST_WORDS = b"error: a unit ended the process of the run; there are no results\n"


class _State:
    """Whether units are at work, who then may not end the process."""

    at_work = False


@contextmanager
def undisturbed() -> Iterator[None]:
    """Keep what units change of the process from the results, and an end of the process from success.

    The working folder and the mask of files are those of before at the end. Until then ``os._exit`` is an
    error of the unit that calls it, and an end of Python has the status of a process that died.
    """
    folder, mask = Path.cwd(), umask()
    _State.at_work = True
    os._exit = _refuse
    try:
        yield
    finally:
        os._exit = _leave
        _State.at_work = False
        os.umask(mask)
        with suppress(OSError):  # gone meanwhile
            os.chdir(folder)


def _refuse(status: int = 0) -> NoReturn:
    raise RuntimeError(f"tried to end the process with status {status}")


@atexit.register
def _at_exit() -> None:
    if _State.at_work:
        with suppress(OSError):
            os.write(2, _LAST_WORDS)
        _leave(PROCESS_DIED)
