"""What a user agreed to, kept where others can write: vouched for by a key that only this user has."""

from __future__ import annotations

import hmac
import os
import secrets
from collections.abc import Iterable, Mapping
from contextlib import suppress
from pathlib import Path

import platformdirs

_SIZE = 32


def vouch(digests: Iterable[str]) -> dict[str, str]:
    """Return a voucher for each digest; none where no key can be kept."""
    key = _key(make=True)
    return {digest: _voucher(key, digest) for digest in digests} if key else {}


def vouched(vouchers: Mapping[str, str]) -> frozenset[str]:
    """The digests whose vouchers this user made."""
    key = _key()
    return (
        frozenset(
            digest
            for digest, voucher in vouchers.items()
            if hmac.compare_digest(voucher, _voucher(key, digest))
        )
        if key
        else frozenset()
    )


def _voucher(key: bytes, digest: str) -> str:
    return hmac.new(key, digest.encode(), "sha256").hexdigest()


def _key(*, make: bool = False) -> bytes:
    """The user's key, empty if there is none."""
    path = platformdirs.user_state_path("bladeloss", appauthor=False) / "voucher-key"
    with suppress(OSError):
        if make and not path.exists():
            _create(path)
        key = path.read_bytes()
        return key if len(key) == _SIZE else b""
    return b""


def _create(path: Path) -> None:
    """Make the key, whole, and never in the place of another that some other process has just made."""
    path.parent.mkdir(parents=True, exist_ok=True)
    fresh = path.with_name(f"{path.name}.{secrets.token_hex(8)}")
    with os.fdopen(os.open(fresh, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "wb") as file:
        file.write(secrets.token_bytes(_SIZE))
    try:
        os.link(fresh, path)
    finally:
        fresh.unlink()
