"""Part of benchmark a: the plain journal bearing of ROSS (ross-rotordynamics), where it is installed.

ROSS solves for the temperature too, so that the two models differ; what they have in common is the
task: position under a load, with stiffness and damping.
"""

from __future__ import annotations

from importlib.util import find_spec
from time import process_time

import numpy as np

from bearing_fmu.film import make_film
from bearing_fmu.parameters import BearingParameters

RADIUS, WIDTH, CLEARANCE, SPEED, LOAD = 0.2, 0.263144, 1.95e-4, 30.0 * np.pi, 112814.91
VISCOSITY = 0.0198  # ISO VG 32 at the 50 degrees of the example, Pa s


def example_of_ross() -> tuple[float, float]:
    """The example of its documentation: processor time [s] and relative eccentricity."""
    from ross.bearings.plain_journal import PlainJournal

    begin = process_time()
    bearing = PlainJournal(
        n=0,
        axial_length=WIDTH,
        journal_radius=RADIUS,
        radial_clearance=CLEARANCE,
        elements_circumferential=11,
        elements_axial=3,
        n_pad=2,
        pad_arc_length=176,
        preload=0,
        geometry="circular",
        reference_temperature=50,
        frequency=[SPEED],
        fxs_load=0,
        fys_load=-LOAD,
        groove_factor=[0.52, 0.48],
        lubricant="ISOVG32",
        sommerfeld_type=2,
        initial_guess=[0.1, -0.1],
        method="perturbation",
        operating_type="flooded",
        oil_supply_pressure=0,
        oil_flow_v=6.31e-4,
    )
    return process_time() - begin, float(bearing.equilibrium_pos[0])


def equilibrium_of_v1() -> tuple[float, float, int]:
    """The same bearing as a full circle without temperature: time [s], eccentricity, evaluations."""
    film = make_film("v1", BearingParameters(2.0 * RADIUS, WIDTH, CLEARANCE, VISCOSITY))
    film.respond(np.zeros(4), np.zeros(4), SPEED)
    begin, evaluations = process_time(), 0
    q, missing = np.array([0.3, -0.5, 0.0, 0.0]) * CLEARANCE, np.array([0.0, LOAD])
    while np.abs(missing).max() > 1e-9 * LOAD and evaluations < 50:
        response = film.respond(q, np.zeros(4), SPEED)
        evaluations += 1
        missing = np.array([0.0, LOAD]) - response.wrench[:2]
        step = np.linalg.solve(response.stiffness[:2, :2], -missing)
        q[:2] += step * min(1.0, 0.3 * response.h_min / np.hypot(*step))
    return process_time() - begin, response.eccentricity, evaluations


def compare_with_ross() -> None:
    """Print a line."""
    if find_spec("ross") is None:
        print("ROSS (ross-rotordynamics) is not installed: its plain journal bearing is left out.")
        return
    theirs, ours = example_of_ross(), equilibrium_of_v1()
    print(
        "Position and coefficients of one bearing under a load: "
        f"ROSS, two pads with temperature, 11 x 3 cells: {theirs[0]:.2f} s, eccentricity {theirs[1]:.3f}; "
        "V1 48 x 8, full circle without temperature: "
        f"{1e3 * ours[0]:.2f} ms in {ours[2]} evaluations, eccentricity {ours[1]:.3f}"
    )


if __name__ == "__main__":
    compare_with_ross()
