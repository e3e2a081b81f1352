"""Other designs of the turbine train that come with it, each a file of a train beside its own.

``python -m rotor_fmu.train.turbine_designs rotor_fmu/data/turbine`` writes all.
"""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

from rotor_fmu.train.train import Train
from rotor_fmu.train.turbine_geometry import JournalDesign, TurbineDesign, turbine_train
from rotor_fmu.train.writer import shaft_csv, train_toml, write_train

SUBHARMONIC = TurbineDesign(
    lp_core_diameter=1.12,
    lp_wheel_mass=31.551e3,
    lp=JournalDesign(0.832, 1.0, 1.8346e-03, -4.631e-05),
    viscosity=0.01296,
    roughness=4.3e-6,
    contact_modulus=10e9,
    friction=0.04,
    lp_balance=0.85,
    rayleigh_alpha=0.6,
    turned=-270.0,  # a quarter of a turn, with phases below one
)
"""With the blade of the scenario ``paper`` V1 answers at half the speed, V2 less and V3 hardly."""
DESIGNS = {"subharmonic": SUBHARMONIC}


def drawn(name: str) -> Train:
    """The train of a design."""
    return replace(turbine_train(DESIGNS[name]), name=f"turbine-{name}")


def files(name: str) -> dict[str, str]:
    """What is written of it, by name of the file."""
    train = drawn(name)
    head, _, rest = train_toml(train).partition("\n")
    return {f"{name}.toml": f'{head}\nshaft = "{name}.csv"\n{rest}', f"{name}.csv": shaft_csv(train)}


def main() -> None:
    """Write the train and all other designs into the folder given."""
    write_train(turbine_train(), Path(sys.argv[1]))
    for name in DESIGNS:
        for file, text in files(name).items():
            (Path(sys.argv[1]) / file).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
