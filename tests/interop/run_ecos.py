"""Run an SSP in ecos."""

import sys
from zipfile import ZipFile

import numpy as np
from ecospy import EcosLib, EcosSimulation
from fmpy.ssp.ssd import read_ssd


def main(ssp: str, step: float, end: float, out: str) -> None:
    EcosLib.set_log_level("debug")
    assert ZipFile(ssp).testzip() is None
    bearings = [c.name for c in read_ssd(ssp).system.elements if c.name != "rotor"]
    forces = []
    with EcosSimulation(ssp_path=ssp, step_size=step) as simulation:
        simulation.init(parameter_set="initialValues")  # without the name ecos leaves parameters alone
        for k in range(round(end / step)):
            if not simulation.step() > k * step:
                sys.exit(f"ecos: the run failed: {EcosLib.get_last_error()}")
            forces.append([[simulation.get_real(f"{n}::wrench.{a}") for a in ("Fx", "Fy")] for n in bearings])
        simulation.terminate()
    np.savez(out, forces=np.array(forces), names=bearings)


if __name__ == "__main__":
    main(sys.argv[1], float(sys.argv[2]), float(sys.argv[3]), sys.argv[4])
