"""What happens in an SSP: blades that break, a speed that changes, and events that its annotation tells."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from fmus import port
from orchestrator.scenario.events import from_json
from orchestrator.ssp.contents import Contents, value_of
from orchestrator.ssp.structure import SspError


def wheel_values(contents: Contents, key: str) -> list[float]:
    """Values of the rotor by wheel."""
    wheels = range(1, len(contents.train.wheels) + 1)
    return [float(value_of(contents, contents.rotor, f"wheel[{j}].{key}")) for j in wheels]


def events_of(contents: Contents, end: float, path: Path) -> list[dict[str, Any]]:
    """The blades that break before the end, and what the annotation tells."""
    time = float(value_of(contents, contents.rotor, "fracture.time"))
    lost = zip(
        contents.train.wheels,
        wheel_values(contents, "blade_unbalance"),
        wheel_values(contents, "blade_phase"),
        strict=True,
    )
    found: list[dict[str, Any]] = [
        {"wheel": wheel.name, "unbalance": unbalance, "phase": phase, "time": time}
        for wheel, unbalance, phase in lost
        if unbalance != 0.0 and time < end
    ]
    for at, wheel, unbalance, phase in json.loads(_text(contents, port.LOSSES) or "[]"):
        if at is not None and at < end:
            name = contents.train.wheels[int(wheel) - 1].name
            found.append({"wheel": name, "unbalance": unbalance, "phase": phase, "time": at})
    try:
        others = from_json(contents.structure.events or "[]")
    except (ValueError, TypeError, AttributeError, ValidationError) as error:
        reason = " ".join(str(error).split())
        raise SspError(f"{path}: events = {contents.structure.events!r}: {reason}") from None
    return found + [event.model_dump(exclude_defaults=True) | {"kind": event.kind} for event in others]


def rotation_of(contents: Contents) -> dict[str, Any] | None:
    """How the speed changes, where the connections say that the rotor owns it."""
    if not contents.turning:
        return None
    values = {
        name: float(value_of(contents, contents.rotor, f"drive.{name}"))
        for name in ("inertia", "windage", "windage_broken")
    }
    values["inertia"] = values["inertia"] or None  # type: ignore[assignment]
    texts = {key: _text(contents, name) for key, name in (("course", port.COURSE), ("torque", port.TORQUE))}
    return values | {key: json.loads(text) for key, text in texts.items() if text}


def _text(contents: Contents, name: str) -> str:
    if name not in contents.files[contents.rotor.name].variables:
        return ""
    value = value_of(contents, contents.rotor, name)
    return "" if value is None or value == math.inf else str(value)
