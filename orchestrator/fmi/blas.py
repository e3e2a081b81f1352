"""Linear algebra on one thread, wherever shafts are reduced and units step."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import scipy.linalg  # noqa: F401  # its library must be loaded to be limited
from threadpoolctl import threadpool_limits


@contextmanager
def one_blas_thread() -> Iterator[None]:
    """Give linear algebra one thread; a context or a decorator.

    On matrices of this size more of them wait for one another, and for the threads of the bearings: a run
    takes four times as long. They also change the last bits: shafts that are reduced while FMUs are built
    stay in the process and count in its runs, so that building is limited, too.
    """
    with threadpool_limits(1, user_api="blas"):
        yield
