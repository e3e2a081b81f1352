"""Row 14: where along the shaft V2 and V3 vibrate, and why V3 stays below V2 in the first swing.

``python orchestrator/study/paper/experiments/orderings.py`` runs the bundled train on V2 and V3 films across
the fracture and keeps the largest vibration amplitude and stress of every node.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from orchestrator.study.paper.calibration.coupled import CoupledTrain
from orchestrator.study.paper.calibration.films import GAP
from orchestrator.study.paper.calibration.measures import bearing_index
from orchestrator.study.paper.experiments.drawing import COLOURS, figure, save
from rotor_fmu.train.turbine_geometry import turbine_train
from rotor_fmu.vibration.rotor import Rotor

WHEEL, UNBALANCE, ANALYSED, FRACTURE, END, STEP = "LP1-2", 265.0, "LP1-front", 0.2, 0.6, 1e-4


def envelopes(depth: str) -> tuple[NDArray[np.float64], NDArray[np.float64], float]:
    """Largest amplitude and stress of each node after the fracture; least gap at the analysed bearing."""
    train = turbine_train()
    coupled = CoupledTrain(train, depth, reduction="craig-bampton")
    index, wheel = bearing_index(train, ANALYSED), [w.name for w in train.wheels].index(WHEEL)
    unbalance = np.zeros(len(train.wheels))
    unbalance[wheel] = UNBALANCE
    rotor = Rotor(train, reduction="craig-bampton", blade_unbalance=unbalance, fracture_time=FRACTURE)
    rotor.start_from_law(*coupled.law, orbit=True)
    law = coupled.films.evaluate(rotor.kinematics())
    amplitude, stress, gap = np.zeros(train.nodes), np.zeros(train.nodes), np.inf
    for k in range(round(END / STEP)):
        rotor.step(k * STEP, STEP, *law, train.speed)
        law = coupled.films.evaluate(rotor.kinematics())
        if k * STEP >= FRACTURE and k % 5 == 0:
            fields = rotor.fields()
            amplitude, stress = np.maximum(amplitude, fields.amplitude), np.maximum(stress, fields.stress)
            gap = min(gap, coupled.films.outputs[index, GAP])
    return amplitude, stress, float(gap)


def main() -> None:
    """Print the largest values and draw them along the shaft."""
    train = turbine_train()
    z, node = np.array(train.z), train.bearings[bearing_index(train, ANALYSED)].node
    found = {depth: envelopes(depth) for depth in ("v2", "v3")}
    for depth, (amplitude, stress, gap) in found.items():
        print(
            f"{depth}: largest amplitude {amplitude.max() * 1e3:.3f} mm at z {z[amplitude.argmax()]:.2f} m, "
            f"in {ANALYSED} {amplitude[node] * 1e3:.3f} mm, least gap there {gap * 1e6:.1f} um; "
            f"stress {stress.max() / 1e6:.2f} N/mm2 at {z[stress.argmax()]:.2f} m"
        )
    difference = (found["v2"][0] - found["v3"][0]) * 1e3
    print(
        f"V2 - V3: {difference[found['v2'][0].argmax()]:.3f} mm at the largest amplitude, "
        f"{difference[node]:.3f} mm in the bearing"
    )
    drawn = figure()
    left, right = drawn.subplots(1, 2)
    for depth, (amplitude, stress, _) in found.items():
        left.plot(z, amplitude * 1e3, color=COLOURS[depth], label=depth.upper())
        right.plot(z, stress / 1e6, color=COLOURS[depth], label=depth.upper(), lw=1)
    left.plot(z, difference, color="0.3", ls="--", lw=1, label="V2 - V3")
    left.plot(
        [z[b.node] for b in train.bearings], np.zeros(len(train.bearings)), "k^", ms=5, label="bearings"
    )
    left.set(xlabel="z, m", ylabel="largest after the fracture, mm", title="Vibration amplitude")
    right.set(xlabel="z, m", ylabel="largest after the fracture, N/mm²", title="Normal stress")
    left.legend(fontsize=8)
    right.legend(fontsize=8)
    save(drawn, __file__)


if __name__ == "__main__":
    main()
