"""Rotor and bearings of all depths in one process, as a tool that knows nothing of bladeloss runs them."""

from itertools import product

import pytest

from bearing_fmu import depths
from fmus import port

H = 1e-4


def connect(rotor, bearings, seats, step):
    """One macro step: rotor under the laws, then the bearings at its journals."""
    t = step * H
    for i, bearing in bearings.items():
        laws = dict(zip(port.LAW, bearing.get(*port.LAW), strict=True))
        rotor.set({port.at_bearing(i, name): value for name, value in laws.items()})
    assert rotor.step(t, H), rotor.said
    for i, bearing in bearings.items():
        names = [port.at_bearing(i, name) for name in port.JOURNAL]
        bearing.set(dict(zip(port.JOURNAL, rotor.get(*names), strict=True)))
        assert bearing.step(t, H), bearing.said


def seat_values(seat):
    return {
        "diameter": seat.diameter,
        "width": seat.width,
        "clearance": seat.clearance,
        "viscosity": seat.viscosity,
        "contact.roughness": seat.roughness,
    }


@pytest.mark.parametrize("depths", list(product(depths.films(), repeat=2))[::2])
def test_a_coupled_train_of_any_depths_runs(hosts, small_train, depths):
    rotor = hosts["rotor_small.fmu"].open("rotor").start()
    bearings = {}
    for i, (seat, depth) in enumerate(zip(small_train.bearings, depths, strict=True), 1):
        start = dict(
            zip(port.JOURNAL, rotor.get(*(port.at_bearing(i, n) for n in port.JOURNAL)), strict=True)
        )
        centre = {"offset.x": start["journal.x"], "offset.y": start["journal.y"] + 0.5 * seat.clearance}
        tilts = {f"offset.{q}": start[f"journal.{q}"] for q in ("tilt_x", "tilt_y")}
        values = seat_values(seat) | start | centre | tilts | {"speed": small_train.speed}
        bearings[i] = hosts[f"bearing_{depth}.fmu"].open(f"bearing{i}").start(values)
    for step in range(20):
        connect(rotor, bearings, small_train.bearings, step)
    for i, bearing in bearings.items():
        assert 0.0 < bearing.get("h_min") < 2.0 * small_train.bearings[i - 1].clearance
        assert bearing.get("wrench.Fy") > 0.0
    for instance in (rotor, *bearings.values()):
        instance.close()


def test_eleven_bearings_of_one_file_do_not_mix(hosts):
    host = hosts["bearing_v1.fmu"]
    heights = [-1e-5 * (k + 1) for k in range(11)]
    together = [host.open(f"b{k}").start({"clearance": 5e-4 + 1e-5 * k}) for k in range(11)]
    for bearing, height in zip(together, heights, strict=True):
        bearing.set({"journal.y": height})
    for bearing in reversed(together):
        assert bearing.step(0.0, H)
    for k, (bearing, height) in enumerate(zip(together, heights, strict=True)):
        alone = host.open("alone").start({"clearance": 5e-4 + 1e-5 * k, "journal.y": height})
        assert bearing.get("wrench.Fx", "wrench.Fy") == alone.get("wrench.Fx", "wrench.Fy")
        alone.close()
        bearing.close()
