"""``bladeloss info``: what comes with the package."""

from __future__ import annotations

from rich.console import Console
from rich.table import Table

from orchestrator.scenario.file import bundled_scenarios, load_scenario
from rotor_fmu.train.file import bundled_trains, load_train


def show(console: Console) -> None:
    """Print bundled scenarios and trains."""
    scenarios = Table.grid(padding=(0, 2))
    for name in bundled_scenarios():
        scenario = load_scenario(name)
        what = "; ".join(f"{event.text}, {event.time:g} s" for event in scenario.events) or "no event"
        scenarios.add_row(
            f"[bold]{name}[/bold]", scenario.title, f"train {scenario.train}, {scenario.end:g} s, {what}"
        )
    console.print("[bold underline]Scenarios[/bold underline]", scenarios, "", sep="\n", highlight=False)
    console.print("[bold underline]Trains[/bold underline]")
    for name in bundled_trains():
        train = load_train(name)
        facts = Table.grid(padding=(0, 2))
        facts.add_row(
            f"[bold]{name}[/bold]",
            f"{train.length:g} m, {len(train.shoulders)} shoulders, {train.mass / 1e3:.3g} t, "
            f"{train.speed / 6.283185307179586:g} Hz",
        )
        facts.add_row("bearings", ", ".join(seat.name for seat in train.bearings))
        facts.add_row("wheels", ", ".join(wheel.name for wheel in train.wheels))
        console.print(facts, "", sep="\n", highlight=False)
