"""The holistic model: reduced rotor and all films in one right-hand side, integrated as a whole.

With x = (p, p') the modal state of the shaft about its static equilibrium,

    p'' = - omega^2 p - (D + speed G) p' + B.T (F(q, q') - F_s) + unbalance(t),   q = q_s + B p

where F are the wrenches of the films, evaluated wherever the integrator asks for them.  Nothing is
exchanged, held or extrapolated: this is what every coupling of rotor and bearings has to converge to.
It calls the physics of `rotor_fmu` and `bearing_fmu` directly and shares no code with the orchestrator's
time loop; the matrices, films and start are those of the FMUs.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from bearing_fmu.film import Film, make_film
from bearing_fmu.parameters import BearingParameters
from orchestrator.master.start.equilibrium import Start
from orchestrator.scenario.parameters import rotor_parameters
from orchestrator.scenario.scenario import Scenario
from rotor_fmu.shaft.condensation import Equilibrium
from rotor_fmu.train.train import BearingSeat, Train
from rotor_fmu.vibration.modal_shaft import ModalShaft
from rotor_fmu.vibration.prepared import prepare_shaft
from rotor_fmu.vibration.rotor import Rotor
from rotor_fmu.vibration.state_space import journal_output, state_matrix
from rotor_fmu.vibration.unbalance import Unbalance

Array = NDArray[np.float64]

GRAVITY = 9.80665
"""Start value of the rotor FMU's parameter [m/s2]."""

JOURNAL, SPEED, WRENCH = slice(0, 8), 16, slice(0, 4)
STIFFNESS, DAMPING = slice(8, 24), slice(24, 40)


@dataclass(eq=False)
class Holistic:
    """Rotor and films as one system x' = f(t, x) of 2 m states.

    Attributes
    ----------
    shaft : ModalShaft
        The reduced shaft in its modes.
    static : Equilibrium
        Journals and wrenches of the static equilibrium, about which p counts.
    speed : float
        [rad/s].
    nominal, blade : ndarray, (m, 2)
        Modal forces of the unbalances, factors of (cos, sin)(speed t).
    fracture_time : float
        From when on the second one acts [s].
    films : tuple of Film
        One a bearing.
    offsets : ndarray, (n_b, 4)
        Bearing centres in the fixed frame.
    start : ndarray, (2 m,)
        x at t = 0.
    evaluations : int
        Evaluations of single films so far; one gives wrench and tangent.
    """

    shaft: ModalShaft
    static: Equilibrium[np.float64]
    speed: float
    nominal: Array
    blade: Array
    fracture_time: float
    films: tuple[Film, ...]
    offsets: Array
    start: Array
    evaluations: int = 0

    def __post_init__(self) -> None:
        count = len(self.films)
        self._linear = state_matrix(self.shaft, self.speed)
        self._output = journal_output(self.shaft)
        self._rest = np.zeros((count, 8))
        self._rest[:, :4] = self.static.journals.reshape(count, 4)
        self._inputs = np.zeros((count, 17))
        self._inputs[:, SPEED] = self.speed
        self._responses = np.zeros((count, 58))
        self._at = np.full_like(self.start, np.nan)

    def rates(self, t: float, x: Array, broken: bool) -> Array:
        """Rates x' at (t, x); not finite where a film has no answer: the integrator then takes less."""
        m = self.shaft.size
        rates = self._linear @ x
        force = self._films(x)[:, WRENCH].reshape(-1) - self.static.wrench
        rotation = np.array([math.cos(self.speed * t), math.sin(self.speed * t)])
        rates[m:] += self.shaft.bearing.T @ force + self.nominal @ rotation
        if broken:
            rates[m:] += self.blade @ rotation
        return rates

    def jacobian(self, x: Array) -> Array:
        """df/dx from the films' own tangents, (2 m, 2 m)."""
        m, count = self.shaft.size, len(self.films)
        responses = self._films(x)
        tangent = np.concatenate(
            [responses[:, STIFFNESS].reshape(count, 4, 4), responses[:, DAMPING].reshape(count, 4, 4)], axis=2
        )
        jacobian = self._linear.copy()
        reaction = tangent @ self._output.reshape(count, 8, -1)
        jacobian[m:] -= self.shaft.bearing.T @ reaction.reshape(4 * count, -1)
        return jacobian

    def responses(self, states: Array) -> Array:
        """Outputs of the bearings at states (n, 2 m), (n, n_b, 58); not counted as evaluations."""
        before = self.evaluations
        result = np.array([self._films(x).copy() for x in states])
        self.evaluations = before
        return result

    def state_scale(self) -> Array:
        """Size of the states, (2 m,): a journal displaced by its clearance, and that at running speed."""
        clearance = min(film.parameters.clearance for film in self.films)
        displacement = clearance / np.abs(self.shaft.bearing[0::4]).max()
        return np.repeat([displacement, displacement * self.speed], self.shaft.size)

    def _films(self, x: Array) -> Array:
        """Outputs of all bearings at a state; kept, so that rates and tangent there cost one evaluation."""
        if np.array_equal(x, self._at):
            return self._responses
        self._inputs[:, JOURNAL] = self._rest + (self._output @ x).reshape(-1, 8)
        for k, film in enumerate(self.films):
            if film.solve(self._inputs[k], self.offsets[k], self._responses[k]):
                self._responses[k] = np.nan
        self.evaluations += len(self.films)
        self._at[:] = x
        return self._responses


def holistic_model(scenario: Scenario, train: Train, start: Start) -> Holistic:
    """The holistic model of a scenario.

    Parameters
    ----------
    scenario : Scenario
        Depths, film resolution, reduction, unbalance and event.
    train : Train
        Its train.
    start : Start
        Offsets and start positions; with the scenario they define a run.
    """
    excitation = unbalance_of(scenario, train)
    shaft = prepare_shaft(train, scenario.reduction)
    rotor = Rotor(shaft, excitation, gravity=GRAVITY, speed=train.speed)
    rotor.start_from_positions(start.static, start.cosine, start.sine)
    state = rotor.get_state()
    return Holistic(
        shaft=shaft.modal,
        static=state.static,
        speed=train.speed,
        nominal=excitation.nominal_force(shaft.modal, train.speed),
        blade=excitation.forces(shaft.modal, train.speed)[:, 2:4],
        fracture_time=excitation.fracture_time,
        films=tuple(
            make_film(scenario.depth_of(seat.name), film_parameters(seat, scenario))
            for seat in train.bearings
        ),
        offsets=start.offsets.copy(),
        start=rotor.modal_state().copy(),
    )


def film_parameters(seat: BearingSeat, scenario: Scenario) -> BearingParameters:
    """Parameters of the film in a bearing of the train."""
    return BearingParameters(
        diameter=seat.diameter,
        width=seat.width,
        clearance=seat.clearance,
        viscosity=seat.viscosity,
        ambient_pressure=seat.ambient_pressure,
        roughness=seat.roughness,
        contact_modulus=seat.contact_modulus,
        friction=seat.friction,
        columns=scenario.film.columns,
        rows=scenario.film.rows,
    )


def unbalance_of(scenario: Scenario, train: Train) -> Unbalance:
    """Unbalance of the wheels before and after the fracture, as the rotor FMU is given it."""
    values = rotor_parameters(scenario, train)
    amount, phase, blade, blade_phase = (
        [values[f"wheel[{j}].{key}"] for j in range(1, len(train.wheels) + 1)]
        for key in ("unbalance", "unbalance_phase", "blade_unbalance", "blade_phase")
    )
    return Unbalance.of_train(train, amount, phase, blade, blade_phase, float(values["fracture.time"]))
