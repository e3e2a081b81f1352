"""Validate FMUs and SSPs: ``python -m tests.validate_fmus [FILE...]`` lists all findings and counts them.

Without files it builds the FMUs of all bundled trains, and the SSP of the small one, and validates these.
FMUs: fmpy (schema, names, units, causalities, model structure) and fmutool of fmu-manipulation-toolbox
(schema, semantics). SSPs: the schemas of SSP 1.0, and the FMUs inside.
"""

import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from importlib.util import find_spec
from pathlib import Path
from zipfile import ZipFile

from fmpy.ssp.ssd import read_ssd, read_ssv
from fmpy.validation import validate_fmu

from orchestrator.fmi.folder import build
from orchestrator.scenario.file import load_scenario
from orchestrator.ssp.export import export
from rotor_fmu.train.file import bundled_trains, load_train

FMUTOOL = "fmu_manipulation_toolbox"
_CLEAN = ("seems to be compliant", "No semantic error")
_FMUTOOL_CALL = f"from {FMUTOOL}.cli.fmutool import fmutool; fmutool()"


def findings(path: Path) -> Iterator[str]:
    """Yield what is wrong with an FMU or an SSP."""
    yield from (_of_ssp if path.suffix == ".ssp" else _of_fmu)(path)


_known: dict[bytes, list[str]] = {}


def _of_fmu(path: Path) -> list[str]:
    """What is wrong with an FMU; one that is there several times, as in SSPs, is looked at once."""
    content = path.read_bytes()
    if content not in _known:
        _known[content] = list(_wrong_with(path))
    return _known[content]


def _wrong_with(path: Path) -> Iterator[str]:
    yield from (f"{path.name}: fmpy: {problem}" for problem in validate_fmu(str(path)))
    if find_spec(FMUTOOL) is None:
        return
    command = [sys.executable, "-c", _FMUTOOL_CALL, "-input", str(path), "-check"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    report = done.stdout + done.stderr
    yield from (f"{path.name}: fmutool: {line}" for line in report.splitlines() if "rror |" in line)
    if done.returncode or not all(text in report for text in _CLEAN):
        yield f"{path.name}: fmutool: ended with {done.returncode}: {report}"


def _of_ssp(path: Path) -> Iterator[str]:
    try:
        read_ssd(str(path), validate=True)
        with ZipFile(path) as archive:
            names = archive.namelist()
        for name in names:
            if name.endswith(".ssv"):
                read_ssv(str(path), name, validate=True)
    except Exception as error:  # fmpy raises bare exceptions
        yield f"{path.name}: {error}"
        return
    with tempfile.TemporaryDirectory() as folder, ZipFile(path) as archive:
        for name in names:
            if name.endswith(".fmu"):
                yield from _of_fmu(Path(archive.extract(name, folder)))


def product(folder: Path) -> list[Path]:
    """Build what bladeloss ships: rotors of the bundled trains, bearings, SSPs of the small train."""
    files = build(folder, [load_train(name) for name in bundled_trains()])
    return files + export(load_scenario("small", {"depth": "v3"}), folder, folder / "small.ssp", "small")


def main(arguments: Sequence[str]) -> int:
    """Print the findings; return how many there are."""
    with tempfile.TemporaryDirectory() as folder:
        paths = [Path(a) for a in arguments] or product(Path(folder))
        found = 0
        for path in paths:
            problems = list(findings(path))
            found += len(problems)
            print("\n".join([f"{path.name}: {len(problems)} findings", *problems]), flush=True)
    if find_spec(FMUTOOL) is None:
        print(f"not run: fmutool, for {FMUTOOL} is not installed")
    print(f"{found} findings in {len(paths)} files")
    return min(found, 1)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
