"""Row 14: where along the shaft V2 and V3 vibrate, and why V3 stays below V2 in the first swing.

``python -m orchestrator.study.paper.experiments.orderings`` runs the bundled train on V2 and V3 films across
the fracture and keeps the largest vibration amplitude and stress of every node.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from orchestrator.results.statistics import interval_extreme, series
from orchestrator.study.paper.calibration.bench import Bench, bearing_index, bench
from orchestrator.study.paper.experiments.drawing import COLOURS, figure, save
from rotor_fmu.train.turbine_geometry import turbine_train

ANALYSED, FRACTURE, END = "LP1-front", 0.2, 0.6
BLADE = {"wheel": "LP1-2", "unbalance": 265.0, "time": FRACTURE}


def envelopes(place: Bench, depth: str) -> tuple[NDArray[np.float64], NDArray[np.float64], float]:
    """Largest amplitude and stress of each node after the fracture; least gap at the analysed bearing."""
    settings = {"end": END, "reduction": "craig-bampton", "record": {"interval": 5e-4}}
    record = place.run(turbine_train(), depth, BLADE, **settings)
    behind = record.where(record["time"] > FRACTURE, drop=True)
    gap = interval_extreme(behind, "least_gap_min", ANALYSED, series(behind, "least_gap", ANALYSED))
    amplitude, stress = (behind[name].max("time").values for name in ("amplitude", "stress"))
    return amplitude, stress, float(gap.min())


def main() -> None:
    """Print the largest values and draw them along the shaft."""
    train = turbine_train()
    z, node = np.array(train.z), train.bearings[bearing_index(train, ANALYSED)].node
    with bench() as place:
        found = {depth: envelopes(place, depth) for depth in ("v2", "v3")}
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
