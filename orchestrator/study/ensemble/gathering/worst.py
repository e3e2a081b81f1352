"""The worst runs of a study, once more by the own command: each with its results and its report."""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import tomlkit
import xarray as xr
from rich.console import Console

from bearing_fmu import depths as registry
from orchestrator.errors import OrchestratorError
from orchestrator.report.library import require_library
from orchestrator.results.ensemble.figures import is_worse, one_number
from orchestrator.results.ensemble.files import WORST, name_of_run
from orchestrator.scenario.file import scenario_toml, train_source
from orchestrator.scenario.scenario import is_fmu
from orchestrator.study.children import Child, run_children
from orchestrator.study.ensemble.running.subject import Sample, ScenarioSubject
from orchestrator.study.ensemble.sampling.changes import TRAIN
from orchestrator.study.progress import show_runs
from rotor_fmu.train.file import bundled_file

_TIES = ("contact_max", "force_max")
_BESIDE = (".csv", ".toml")


def worst_runs(data: xr.Dataset, rank: str, count: int) -> list[tuple[int, str]]:
    """Sample and depth of the worst runs, the worst first; of each sample at its deepest depth."""
    if rank not in data:
        return []
    order = [d for d in registry.names() if d in data["depth"].values] or list(data["depth"].values)
    keys = [
        is_worse(one_number(data, n).transpose("sample", "depth").values, n)
        for n in (rank, *_TIES)
        if n in data
    ]
    places = {str(depth): k for k, depth in enumerate(data["depth"].values)}
    found = []
    for sample in range(data.sizes["sample"]):
        depth = next((str(d) for d in order if np.isfinite(keys[0][sample, places[str(d)]])), None)
        if depth is not None:
            found.append((tuple(-np.nan_to_num(key[sample, places[depth]]) for key in keys), sample, depth))
    return [(sample, depth) for _, sample, depth in sorted(found)[:count]]


def write_inputs(subject: ScenarioSubject, sample: Sample, depth: str, folder: Path) -> Path:
    """Write the inputs of a sample into a folder, as `bladeloss run` takes them; return the scenario."""
    scenario, _ = subject.inputs(sample, depth)
    folder.mkdir(parents=True, exist_ok=True)
    given = {
        subject.study.parameters[n].key: (v, subject.study.parameters[n].factor) for n, v in sample.items()
    }
    changes = {key.removeprefix(TRAIN): value for key, value in given.items() if key.startswith(TRAIN)}
    own = {b: str((scenario.folder / d).absolute()) if is_fmu(d) else d for b, d in scenario.depth_at.items()}
    update: dict[str, Any] = {"depth_at": own}
    if changes:
        path, raw = subject.train_raw(scenario.train, changes)
        place = folder / "train"
        place.mkdir(exist_ok=True)
        for file in path.parent.iterdir():
            if file.suffix in _BESIDE and file.is_file() and file != path:
                shutil.copyfile(file, place / file.name)
        (place / "train.toml").write_text(tomlkit.dumps(raw), encoding="utf-8")
        update["train"] = "train"
    elif bundled_file(scenario.train) is None:
        update["train"] = str(Path(train_source(scenario)).absolute())
    text = scenario_toml(scenario.model_copy(update=update))
    target = folder / "scenario.toml"
    target.write_text(text, encoding="utf-8")
    return target


@dataclass(frozen=True)
class Again:
    """How the worst runs are carried out.

    Attributes
    ----------
    folder : Path
        Of the study.
    jobs : int
        At once.
    trust : bool
        Run FMUs of others.
    console : rich.console.Console
        Shows the progress.
    """

    folder: Path
    jobs: int
    trust: bool
    console: Console

    def carry_out(self, subject: ScenarioSubject, samples: Any, runs: Sequence[tuple[int, str]]) -> int:
        """Do those runs of a list that are not there yet; return how many of them have their results."""
        place = self.folder / WORST
        options = ["--fmus", str(subject.fmus.absolute()), "--budget", str(subject.budget), "--no-figures"]
        options += ["--trust"] if self.trust else []
        try:
            require_library()
            options.append("--report")
        except OrchestratorError as error:
            self.console.print(str(error), highlight=False, soft_wrap=True)
        children = []
        for index, depth in runs:
            name = name_of_run(index, depth)
            if (place / name / "record.nc").is_file():
                continue
            scenario = write_inputs(subject, samples[index], depth, place / f"{name}-input")
            children.append(Child(name, (str(scenario), *options), (place / name).absolute()))
        if children:
            said = f"Results of the worst {len(children)} runs, in {place}"
            self.console.print(said, highlight=False, soft_wrap=True)
            quiet = self.console if self.console.is_terminal else Console(quiet=True)
            with show_runs([child.name for child in children], quiet) as show:
                run_children(children, self.jobs, show)
        return sum((place / name_of_run(i, d) / "record.nc").is_file() for i, d in runs)
