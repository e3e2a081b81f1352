"""``bladeloss info``: what comes with the package, or one train as it is read."""

from __future__ import annotations

import json

from rich.console import Console
from rich.table import Table

from orchestrator.results.quantities import HERTZ
from orchestrator.scenario.file import bundled_scenarios, load_scenario, read_train
from rotor_fmu.linear.analysis import target_loads
from rotor_fmu.train.file import bundled_trains, derived_trains, load_train
from rotor_fmu.train.seat import BearingSeat
from rotor_fmu.train.train import Coupling, Shoulder, Train


def show(console: Console) -> None:
    """Print bundled scenarios and trains."""
    scenarios = Table.grid(padding=(0, 2))
    for name in bundled_scenarios():
        scenario = load_scenario(name)
        what = "; ".join(f"{event.text} {event.when}" for event in scenario.events) or "no event"
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
            f"{train.speed / HERTZ:g} Hz",
        )
        facts.add_row("bearings", ", ".join(seat.name for seat in train.bearings))
        facts.add_row("wheels", ", ".join(wheel.name for wheel in train.wheels))
        if others := derived_trains(name):
            facts.add_row("derived", ", ".join(others))
        console.print(facts, "", sep="\n", highlight=False)


def show_train(source: str, console: Console) -> None:
    """Print a train: lengths in mm, loads in N.

    Raises
    ------
    OrchestratorError
        When it cannot be read.
    """
    train = read_train(source)
    gravity = ", ".join(f"{g:g}" for g in train.gravity)
    console.print(
        f"[bold]{train.name}[/bold]  {train.length:g} m, {train.mass:.5g} kg, "
        f"{train.speed / HERTZ:g} Hz ({60.0 * train.speed / HERTZ:.6g} rev/min), gravity ({gravity}) m/s2",
        highlight=False,
    )
    tables = [_seats(train), _films(train), _bodies(train), _shaft(train)]
    console.print(*(table for table in tables if table.row_count), sep="\n")


def _seats(train: Train) -> Table:
    table = Table(title="Bearings, and their static loads against gravity", title_justify="left")
    for name in ("bearing", "z, mm", "diameter, mm", "height, mm", "load, N"):
        table.add_column(name, justify="left" if name == "bearing" else "right")
    loads = target_loads(train)
    if any(seat.height is not None for seat in train.bearings):
        table.caption = "As in short plain films; on their own, which a run finds, loads differ a little."
    for seat, load in zip(train.bearings, loads, strict=True):
        height = "" if seat.height is None else f"{1e3 * seat.height:g}"
        diameter = f"{1e3 * seat.diameter:g}" + (", sleeve" if seat.sleeve else "")
        held = ", held down" if load < 0.0 else ""
        table.add_row(
            seat.name, _mm(train.z[seat.node]), diameter if seat.has_film else "", height, f"{load:.4g}{held}"
        )
    return table


def _films(train: Train) -> Table:
    """What films know of the bearings that have one, in the units of a drawing."""
    table = Table(title="Films, and what the bearings stand on", title_justify="left")
    for name in ("bearing", "bore", "width\nmm", "clearance\nµm", "oil", "pedestal x, y\nkN/mm"):
        table.add_column(name, justify="right" if name.endswith("m") else "left")
    if any(seat.has_film and seat.oil for seat in train.bearings):
        table.caption = (
            "Of an oil that finds its temperature: viscosity at 40 °C, and how warm it is supplied."
        )
    for seat in train.bearings:
        if seat.has_film:
            table.add_row(
                seat.name, _bore(seat), _mm(seat.width), f"{1e6 * seat.clearance:g}", _oil(seat), _stand(seat)
            )
    return table


def _bore(seat: BearingSeat) -> str:
    arcs = json.loads(seat.bore) if seat.has_grooves else []
    pads = sum(len(arc) > 4 and arc[4] is not None for arc in arcs)
    words = f"{pads} pads" if pads else f"{len(arcs)} arcs" if arcs else "plain"
    layer = f", layer {_mm(seat.layer_thickness)} mm" if seat.layer_thickness > 0.0 else ""
    return words + layer


def _oil(seat: BearingSeat) -> str:
    if seat.oil is None:
        return f"{1e3 * seat.viscosity:g} mPa s"
    return f"{1e6 * seat.viscosity_40:.4g} mm2/s, {seat.supply_temperature - 273.15:.4g} °C"


def _stand(seat: BearingSeat) -> str:
    if seat.pedestal is None:
        return ""
    return ", ".join(f"{1e-6 * spring:g}" for spring in seat.pedestal.stiffness)


def _bodies(train: Train) -> Table:
    table = Table(title="What sits on the shaft", title_justify="left")
    for name in ("name", "z, mm", "what it is"):
        table.add_column(name, justify="right" if name.startswith("z") else "left")
    rows = [
        (body.node, body.name, f"{kind}, {body.mass:g} kg, polar {body.polar_inertia:g}, transverse "
         f"{body.transverse_inertia:g} kg m2")
        for kind, bodies in (("wheel", train.wheels), ("mass", train.masses))
        for body in bodies
    ]  # fmt: skip
    rows += [(coupling.node, coupling.name, _coupling(train, coupling)) for coupling in train.couplings]
    for node, name, text in sorted(rows):
        table.add_row(name, _mm(train.z[node]), text)
    return table


def _coupling(train: Train, coupling: Coupling) -> str:
    joint = train.joint_of(coupling)
    if joint is None:
        return "rigid coupling"
    return (
        f"elastic coupling, {joint.translational_stiffness:g} N/m, {joint.angular_stiffness:g} N m/rad, "
        f"{joint.translational_damping:g} N s/m, {joint.angular_damping:g} N m s/rad"
    )


def _shaft(train: Train) -> Table:
    table = Table(title="Shoulders, from front to rear", title_justify="left")
    for name in ("z, mm", "length, mm", "rings: outer x inner diameter in mm, material"):
        table.add_column(name, justify="left" if name.startswith("rings") else "right")
    for z, shoulder in zip(train.z, train.shoulders, strict=False):
        if shoulder.joint is None:
            table.add_row(_mm(z), _mm(shoulder.length), _rings(shoulder))
    return table


def _rings(shoulder: Shoulder) -> str:
    words = []
    for ring in shoulder.rings:
        ends = [f"{_mm(ring.outer(share))} x {_mm(ring.inner(share))}" for share in (0.0, 1.0)]
        only = "" if ring.counts == "both" else f", {ring.counts} only"
        words.append(f"{' to '.join(dict.fromkeys(ends))} {ring.material.name}{only}")
    return "; ".join(words)


def _mm(metres: float) -> str:
    return f"{1e3 * metres:g}"
