"""Run the units of an SSP in PyFMI, whose master reads connections, and no SSP."""

import sys
import tempfile
from pathlib import Path

import numpy as np
from fmpy import extract
from fmpy.ssp.ssd import read_ssd, read_ssv
from pyfmi import load_fmu
from pyfmi.master import Master


def main(ssp: str, step: float, end: float, out: str) -> None:
    folder = Path(tempfile.mkdtemp())
    extract(ssp, str(folder))
    system, units = read_ssd(ssp).system, {}
    for component in system.elements:
        unit = load_fmu(str(folder / component.source), kind="CS", log_level=4)
        for binding in component.parameterBindings:
            for parameter in read_ssv(ssp, binding.source).parameters:
                unit.set(parameter.name, float(parameter.value))
        units[component.name] = unit
    joined = [
        (units[c.startElement], c.startConnector, units[c.endElement], c.endConnector)
        for c in system.connections
    ]
    bearings = [name for name in units if name != "rotor"]
    master = Master(list(units.values()), joined)
    options = master.simulate_options()
    options |= {"step_size": step, "error_controlled": False, "block_initialization": False, "num_threads": 1}
    options["filter"] = {unit: ["wrench.F*"] for unit in units.values()}
    found = master.simulate(0.0, end, options=options)
    steps = round(end / step)
    forces = [[found[units[n]][f"wrench.{a}"][1 : steps + 1] for a in ("Fx", "Fy")] for n in bearings]
    np.savez(out, forces=np.transpose(forces, (2, 0, 1)), names=bearings)


if __name__ == "__main__":
    main(sys.argv[1], float(sys.argv[2]), float(sys.argv[3]), sys.argv[4])
