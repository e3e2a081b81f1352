"""The scenario: what is simulated, how deep, and how it is coupled and recorded.

The models below are the specification of the scenario TOML.  They know nothing of
files or trains; `orchestrator.scenario.file` reads them and checks them against the
train.  SI units and rad.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Annotated, Any, Literal, get_args

from pydantic import Field, PlainValidator, model_validator
from pydantic_core import PydanticCustomError

from bearing_fmu import depths
from fmus import port
from orchestrator.scenario.events import AnyEvent
from orchestrator.scenario.fields import Angle, Grade, Interval, Model, NotNegative
from orchestrator.scenario.rotation import Rotation, speed_on

Reduction = Literal["irs", "irs-plain", "guyan", "craig-bampton", "none"]
CouplingName = Literal["linear-implicit", "multirate", "newton", "iqn-ils", "gauss-seidel", "jacobi"]

REDUCTIONS: tuple[str, ...] = get_args(Reduction)
COUPLINGS: tuple[str, ...] = get_args(CouplingName)


def is_fmu(depth: str) -> bool:
    """Whether a depth is the path of an FMU, somebody's own bearing, and none of `bearing_fmu.depths`."""
    return depth.endswith(".fmu")


def _one_of(allowed: Callable[[], tuple[str, ...]]) -> Any:
    """A word out of some, which may grow."""

    def check(value: Any) -> Any:
        if isinstance(value, str) and value in allowed():
            return value
        raise PydanticCustomError("depth", "not one of them", {"allowed": allowed()})

    return PlainValidator(check)


def _check_depth_or_fmu(value: Any) -> Any:
    if isinstance(value, str) and (is_fmu(value) or value in depths.names()):
        return value
    raise PydanticCustomError("depth", "no depth", {"allowed": (*depths.names(), "the path of an .fmu file")})


Depth = Annotated[str, _one_of(depths.names)]
FilmDepth = Annotated[str, _one_of(depths.films)]
DepthOrFmu = Annotated[str, PlainValidator(_check_depth_or_fmu)]
"""A depth, or the path of an FMU with the port of a bearing."""


class WheelUnbalance(Model):
    """Nominal unbalance of one wheel in place of what the balance grade gives.

    Attributes
    ----------
    unbalance : float
        Mass times eccentricity in kg m.
    phase : float
        Angle at t = 0 in rad.
    """

    unbalance: NotNegative
    phase: Angle = 0.0


class Unbalance(Model):
    """Nominal unbalance of the train.

    Attributes
    ----------
    grade : float or None
        Balance grade e Ω in m/s (G2.5 is 2.5e-3); None takes the train's own.
    at : dict
        Overrides by the name of the wheel.
    """

    grade: Grade = None
    at: dict[str, WheelUnbalance] = {}  # noqa: RUF012 (pydantic copies it)


def _whole(key: str) -> Any:
    """A whole number with range and default of a bearing's parameter."""
    variable = port.bearing_parameter(key)
    return Field(int(variable.start or 0), ge=variable.minimum, le=variable.maximum)


_Boundary = Annotated[str, _one_of(lambda: port.bearing_parameter("boundary").choices)]
_Temperature = Annotated[str, _one_of(lambda: port.bearing_parameter("temperature").choices)]
_Turbulence = Annotated[str, _one_of(lambda: port.bearing_parameter("turbulence").choices)]


class FilmSettings(Model):
    """How the films are solved.

    Attributes
    ----------
    columns, rows : int
        Resolution around the circumference and along the axis of those that solve the Reynolds equation.
    boundary : str
        Where the film ruptures: "guembel", negative pressure is zeroed, as in the paper; "reynolds", pressure
        and its gradient vanish together, which the short bearing does not offer; or "jfo", mass-conserving
        rupture and reformation in time, at depth v1, with oil from grooves or ambient_pressure > 0.
    turbulence : str
        "laminar", as in the paper, or "constantinescu": flow and friction by the local Reynolds number.
    temperature : str
        Of oils given by grade or curve: "held" at that of the equilibrium, or "followed" from there on: each
        film has the temperature of a first-order balance in time.
    """

    columns: int = _whole("columns")
    rows: int = _whole("rows")
    boundary: _Boundary = port.default_word("boundary")
    turbulence: _Turbulence = port.default_word("turbulence")
    temperature: _Temperature = port.default_word("temperature")


class RecordSettings(Model):
    """What is kept.

    Attributes
    ----------
    interval : float
        Time between two records in s, rounded to whole macro steps and never less than one. The extremes of
        every macro step between two records are kept whatever the interval.
    revolutions : bool or None
        Keep of every revolution the orders 1/2, 1 and 2, the overall vibration and the extremes, so that a
        long run needs few records; None: where the speed may change.
    """

    interval: Interval = 5e-4
    revolutions: bool | None = None


class Scenario(Model):
    """One run.

    Attributes
    ----------
    title : str
        Heads summary and figures.
    train : str
        Name of a bundled train, or a train's TOML relative to the scenario's file.
    reduction : str
        Reduction of the shaft, one of `REDUCTIONS`.
    depth : str
        Modelling depth of every bearing, one of `bearing_fmu.depths`.
    depth_at : dict
        Depth by name of the bearing, where it differs; or the path of an FMU with the port of a
        bearing, relative to the scenario's file.
    linear_from : str
        Depth of the film from which a bearing of depth linear has stiffness and damping, at the static
        equilibrium, where its train does not give them.
    unbalance : Unbalance
        Nominal unbalance.
    events : tuple of Event
        What happens, `orchestrator.scenario.events`. A file may have one as the table ``[event]``.
    rotation : Rotation or None
        How the rotor turns, where its speed changes.
    end : float
        End time in s.
    step : float
        Macro step in s; the longest one where a tolerance is given. With coupling multirate the step with
        which the rotor begins; the longest then is the record's interval or a twentieth of a revolution.
    tolerance : float or None
        Largest relative error of a step: of the defect, the wrench of a bearing less the one that the rotor
        was moved by, and of what comes of the step's length, against the larger of the mean static load and
        the bearing's force (moments: times its width); with coupling multirate against the largest force of
        the last revolutions, at least 0.3 of that load. A step that misses it is taken back and halved; the
        couplings newton and iqn-ils iterate the defect away as far, else to 1e-6. None: every step counts,
        but for multirate, which has 0.01 then. It belongs to the step and the coupling beside it: where an
        option replaces one of them, it must be given anew.
    ledger : bool
        Keep the energy ledger: works of films, contact, unbalance, damping, and what the coupling created
        or lost; what that costs stands at the rotor's parameter ``track_work``.
    coupling : str
        Name of the coupling, one of `COUPLINGS`; where it is left out but a step is given, linear-implicit,
        which goes by it.
    film : FilmSettings
        How the films are solved.
    record : RecordSettings
        What is kept.
    analysed_bearing : str or None
        Name of the bearing that summary and figures show; None takes the most loaded one.
    folder : Path
        Folder of the scenario's file, from which a relative train path counts. Not a key of the file.
    """

    title: str = ""
    train: str
    reduction: Reduction = "irs"
    depth: Depth = depths.names()[0]
    depth_at: dict[str, DepthOrFmu] = {}  # noqa: RUF012
    linear_from: FilmDepth = depths.films()[0]
    unbalance: Unbalance = Unbalance()
    events: Annotated[tuple[AnyEvent, ...], Field(strict=False)] = ()
    rotation: Rotation | None = None
    end: Interval
    step: Interval = 1e-4
    tolerance: Annotated[float, Field(gt=0.0, le=1.0)] | None = None
    ledger: bool = False
    coupling: CouplingName = "multirate"
    film: FilmSettings = FilmSettings()
    record: RecordSettings = RecordSettings()
    analysed_bearing: str | None = None
    folder: Path = Field(default=Path(), exclude=True)

    @model_validator(mode="before")
    @classmethod
    def _fixed_with_a_step(cls, raw: Any) -> Any:
        """A step without a coupling: that which goes by it."""
        if isinstance(raw, Mapping) and "step" in raw and "coupling" not in raw:
            return {**raw, "coupling": "linear-implicit"}
        return raw

    @property
    def turns(self) -> bool:
        """Whether its speed changes, or may."""
        return self.rotation is not None

    @property
    def keeps_revolutions(self) -> bool:
        """Whether the record has every revolution."""
        asked = self.record.revolutions
        return self.turns if asked is None else asked

    def start_speed(self, rated: float) -> float:
        """Speed at the start, of a train of this rated speed [rad/s]."""
        course = self.rotation.course if self.rotation is not None else None
        return speed_on(course, 0.0) if course else rated

    def depth_of(self, bearing: str) -> str:
        """Depth of the bearing of this name."""
        return self.depth_at.get(bearing, self.depth)

    def depth_name_of(self, bearing: str) -> str:
        """Depth of the bearing of this name for people: a file without its folder and suffix."""
        depth = self.depth_of(bearing)
        return Path(depth).stem if is_fmu(depth) else depth
