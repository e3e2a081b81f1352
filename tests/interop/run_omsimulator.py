"""Run an SSP in OMSimulator, the native command."""

import csv
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from fmpy.ssp.ssd import read_ssd

from tests.native import environment


def main(ssp: str, step: float, end: float, out: str) -> None:
    bearings = [component.name for component in read_ssd(ssp).system.elements if component.name != "rotor"]
    with tempfile.TemporaryDirectory() as folder:
        result = Path(folder) / "result.csv"
        command = ["OMSimulator", f"--stepSize={step!r}", f"--stopTime={end!r}", f"--resultFile={result}"]
        command += [f"--tempDir={folder}", f"--workingDir={folder}", ssp]
        done = subprocess.run(
            command, env=environment(*sys.path[:1]), capture_output=True, text=True, check=False
        )
        if done.returncode or "\ninfo:    0 errors" not in done.stdout:
            sys.exit(f"OMSimulator ended with {done.returncode}: {done.stdout[-2000:]}{done.stderr[-2000:]}")
        with result.open(newline="") as file:
            names, *rows = (row for row in csv.reader(file) if row)
    columns = [_column(names, f".{name}.wrench.{axis}") for name in bearings for axis in ("Fx", "Fy")]
    values = {round(float(row[0]) / step): [float(row[c]) for c in columns] for row in rows}
    steps = round(end / step)  # of the rows at one time the last counts
    forces = np.array([values[k] for k in range(1, steps + 1)]).reshape(steps, len(bearings), 2)
    np.savez(out, forces=forces, names=bearings)


def _column(names: list[str], ending: str) -> int:
    (found,) = (i for i, name in enumerate(names) if name.endswith(ending))
    return found


if __name__ == "__main__":
    main(sys.argv[1], float(sys.argv[2]), float(sys.argv[3]), sys.argv[4])
