"""Run an SSP in ecos.

Not with fmpy in the same process, which ecos 0.7.2 does not bear: it crashes in `fmi2SetupExperiment`, where
the unit's table of functions lies in a library that is no longer loaded.
"""

import re
import sys
from zipfile import ZipFile

import numpy as np
from ecospy import EcosLib, EcosSimulation


def main(ssp: str, step: float, end: float, out: str) -> None:
    EcosLib.set_log_level("debug")
    archive = ZipFile(ssp)
    assert archive.testzip() is None
    names = re.findall(r'<ssd:Component name="([^"]+)"', archive.read("SystemStructure.ssd").decode())
    bearings = [name for name in names if name != "rotor"]
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
