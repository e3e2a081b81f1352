"""Step an SSP with plain fmpy: all units after one another, each on the newest values of the others."""

import sys
import tempfile
from pathlib import Path

import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE
from fmpy.ssp.ssd import read_ssd, read_ssv


def log(_environment, name, _status, _category, message):
    print(f"{name.decode()}: {message.decode()}", flush=True)


def main(ssp: str, step: float, end: float, out: str) -> None:
    folder = Path(tempfile.mkdtemp())
    system = read_ssd(ssp).system
    unzipped, units, references, callbacks = {}, {}, {}, fmi2CallbackFunctions()
    callbacks.logger = fmi2CallbackLoggerTYPE(log)
    extract(ssp, str(folder))
    for component in system.elements:
        if component.source not in unzipped:
            unzipped[component.source] = extract(str(folder / component.source))
        description = read_model_description(unzipped[component.source])
        unit = FMU2Slave(
            guid=description.guid,
            modelIdentifier=description.coSimulation.modelIdentifier,
            unzipDirectory=unzipped[component.source],
            instanceName=component.name,
        )
        unit.instantiate(callbacks=callbacks, loggingOn=True)
        units[component.name] = unit
        references[component.name] = {v.name: v.valueReference for v in description.modelVariables}
        for binding in component.parameterBindings:
            given = read_ssv(ssp, binding.source).parameters
            words = {v.name for v in description.modelVariables if v.type == "String"}
            texts = {p.name: str(p.value) for p in given if p.name in words}
            values = {p.name: float(p.value) for p in given if p.name not in words}
            known = references[component.name]
            unit.setReal([known[name] for name in values], list(values.values()))
            if texts:
                unit.setString([known[name] for name in texts], list(texts.values()))
        unit.setupExperiment(startTime=0.0)
        unit.enterInitializationMode()
    into = {name: [] for name in units}
    for c in system.connections:
        target = references[c.endElement][c.endConnector]
        into[c.endElement].append((target, c.startElement, references[c.startElement][c.startConnector]))

    def feed(name):
        for source in {source for _, source, _ in into[name]}:
            pairs = [(target, reference) for target, s, reference in into[name] if s == source]
            unit = units[source]
            units[name].setReal([p[0] for p in pairs], unit.getReal([p[1] for p in pairs]))

    order = ["rotor"] * ("rotor" in units) + [name for name in units if name != "rotor"]
    for name in [*order, *order]:
        feed(name)
    for name in order:
        units[name].exitInitializationMode()
    bearings = [name for name in order if name != "rotor"]
    forces = []
    for k in range(round(end / step)):
        for name in order:
            feed(name)
            units[name].doStep(k * step, step)
        get = (units[n].getReal([references[n][f"wrench.{a}"] for a in ("Fx", "Fy")]) for n in bearings)
        forces.append(list(get))
    for unit in units.values():
        unit.terminate()
        unit.freeInstance()
    np.savez(out, forces=np.array(forces), names=bearings)


if __name__ == "__main__":
    main(sys.argv[1], float(sys.argv[2]), float(sys.argv[3]), sys.argv[4])
