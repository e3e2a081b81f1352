"""Ten pairs of runs at once that share a cache, of two trains of one name: ``python -m tests.pairs [PAIRS]``.

Each run must give, to the bit, the forces that it gives alone. Some minutes.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np

from orchestrator.results.record_files import read_record
from rotor_fmu.train.file import load_train
from rotor_fmu.train.writer import write_train

SCENARIO = 'train = "train"\ndepth = "v3"\nend = 0.01\n'
MASSES = (1500.0, 1000.0)


def start(folder: Path, mass: float, out: str) -> subprocess.Popen[bytes]:
    """Start the run of the variant with this wheel."""
    environment = os.environ | {
        "XDG_CACHE_HOME": str(folder / "cache"),
        "PYTHONPATH": str(Path(__file__).parents[1]),
    }
    arguments = ["run", f"{mass:.0f}/s.toml", "--no-figures", "--out", out]
    return subprocess.Popen(
        [sys.executable, "-m", "orchestrator.cli.main", *arguments],
        cwd=folder, env=environment, stdout=subprocess.DEVNULL,
    )  # fmt: skip


def main(pairs: int) -> int:
    """Return how many runs were wrong."""
    with tempfile.TemporaryDirectory(prefix="pairs_") as name:
        folder, train = Path(name), load_train("small")
        for mass in MASSES:
            place = folder / f"{mass:.0f}"
            place.mkdir()
            write_train(
                replace(train, wheels=(replace(train.wheels[0], mass=mass), *train.wheels[1:])),
                place / "train",
            )
            (place / "s.toml").write_text(SCENARIO)
        at_once = [(mass, f"{mass:.0f}-{k}") for k in range(pairs) for mass in MASSES]
        for k in range(pairs):  # the first pair on an empty cache
            started = [start(folder, mass, out) for mass, out in at_once[2 * k : 2 * k + 2]]
            assert [process.wait() for process in started] == [0, 0]
        alone = {mass: f"{mass:.0f}-alone" for mass in MASSES}
        for mass, out in alone.items():
            assert start(folder, mass, out).wait() == 0
        forces = {
            out: read_record(folder / out)["force"].values
            for out in (*alone.values(), *(o for _, o in at_once))
        }
        wrong = [out for mass, out in at_once if not np.array_equal(forces[out], forces[alone[mass]])]
        largest = {mass: float(np.linalg.norm(forces[out], axis=-1).max()) for mass, out in alone.items()}
        print(f"{len(at_once)} runs in {pairs} pairs, largest force {largest}; wrong: {wrong or 'none'}")
        return len(wrong)


if __name__ == "__main__":
    sys.exit(main(int(sys.argv[1]) if len(sys.argv) > 1 else 10))
