"""Numbers in a page: as text of few bytes, which the page's script turns back into arrays."""

from __future__ import annotations

import base64
import gzip
import json
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

_FULL = 32767


def packed(values: ArrayLike, largest: float | None = None) -> dict[str, Any]:
    """Numbers as whole multiples of a step, to 1/65534 of their span, or rounded less; nan stays nan.

    Parameters
    ----------
    values : array_like
        Of any shape; it is kept where there are two dimensions.
    largest : float, optional
        Error that is allowed; larger steps are shorter once the page is packed.
    """
    x = np.asarray(values, dtype=float)
    finite = x[np.isfinite(x)]
    low, high = (float(finite.min()), float(finite.max())) if finite.size else (0.0, 0.0)
    step = max((high - low) / (2 * _FULL), 2.0 * (largest or 0.0)) or 1.0
    middle = (low + high) / 2.0
    numbers: NDArray[np.int16] = np.full(x.shape, -_FULL - 1, dtype="<i2")
    inside = np.isfinite(x)
    numbers[inside] = np.clip(np.round((x[inside] - middle) / step), -_FULL, _FULL).astype("<i2")
    found: dict[str, Any] = {
        "packed": base64.b64encode(numbers.tobytes()).decode(),
        "step": step,
        "at": middle,
    }
    if x.ndim == 2:
        found["columns"] = x.shape[1]
    return found


def unpacked(data: dict[str, Any]) -> NDArray[np.float64]:
    """What `packed` packed."""
    numbers = np.frombuffer(base64.b64decode(data["packed"]), dtype="<i2")
    values = np.where(numbers == -_FULL - 1, np.nan, data["at"] + data["step"] * numbers.astype(float))
    return values.reshape(-1, data["columns"]) if "columns" in data else values


def to_json(data: Any) -> str:
    """JSON that may stand in a script of a page."""
    return json.dumps(data, allow_nan=False, separators=(",", ":"), ensure_ascii=True).replace("</", "<\\/")


def squeezed(text: str) -> str:
    """Text, compressed by gzip, in base64."""
    return base64.b64encode(gzip.compress(text.encode(), 9, mtime=0)).decode()
