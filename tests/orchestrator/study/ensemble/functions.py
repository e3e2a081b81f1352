"""Functions in place of runs: trivial, of known sensitivity, and such as fail in all ways."""

import math
import os
import signal
import time
from pathlib import Path


def total(**numbers):
    """The sum."""
    return {"total": float(sum(numbers.values()))}


def ishigami(x1, x2, x3):
    """Ishigami and Homma (1990) with a = 7, b = 0.1."""
    return {"y": math.sin(x1) + 7.0 * math.sin(x2) ** 2 + 0.1 * x3**4 * math.sin(x1)}


def of_depth(x, depth):
    """A coarse figure and a fine one, which is a tenth more."""
    return {"gap": x * (1.1 if depth == "fine" else 1.0)}


def fails(x, folder):
    """Does what its number says; 5 succeeds at the second try only."""
    mark = Path(folder) / f"{x}-{time.monotonic_ns()}"
    mark.touch()
    tries = len(list(Path(folder).glob(f"{x}-*")))
    if x == 1:
        raise ValueError("out of luck")
    if x == 2:
        os.kill(os.getpid(), signal.SIGKILL)
    if x == 3:
        time.sleep(600.0)
    if x == 4:
        raise SystemExit(77)
    if x == 5 and tries == 1:
        os.kill(os.getpid(), signal.SIGSEGV)
    return float(x)


def takes_its_time(x):
    """The number, after a tenth of a second."""
    time.sleep(0.1)
    return x


def sleeps(x):
    """The number, after as many seconds."""
    time.sleep(x)
    return x
