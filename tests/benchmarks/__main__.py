"""All benchmarks or some of them: ``python -m tests.benchmarks [a b c d e f g h i j]``."""

from __future__ import annotations

import os
import sys

# One BLAS thread: what is compared are methods, and matrices here are too small for more. Before numpy loads.
for _variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_variable, "1")

from tests.benchmarks import (  # noqa: E402
    contact,
    corners,
    error_against_cost,
    film_cost,
    growth,
    macro_step,
    mass_conserving,
    threads,
    turning,
    work_precision,
)

BENCHMARKS = {
    "a": film_cost.main,
    "b": error_against_cost.main,
    "c": macro_step.main,
    "d": growth.main,
    "e": threads.main,
    "f": mass_conserving.main,
    "g": work_precision.main,
    "h": corners.main,
    "i": contact.main,
    "j": turning.main,
}


def main(letters: list[str]) -> int:
    """Run the benchmarks of these letters, all for none; return the exit status."""
    unknown = [letter for letter in letters if letter not in BENCHMARKS]
    if unknown:
        print(f"no benchmark {', '.join(unknown)}; allowed are {', '.join(BENCHMARKS)}", file=sys.stderr)
        return 2
    for letter in letters or BENCHMARKS:
        BENCHMARKS[letter]()
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
