"""Copies of arrays: numba's own assignment compiles a message for shapes that differ, two seconds of it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.kernels.compiled import inner_kernel


@inner_kernel
def copy(source: NDArray[np.float64], target: NDArray[np.float64]) -> None:
    """Copy the first numbers of one array into all of another, both of one dimension.

    Nobody checks lengths: the source must be at least as long as the target.
    """
    for i in range(target.shape[0]):
        target[i] = source[i]
