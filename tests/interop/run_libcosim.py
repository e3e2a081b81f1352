"""Run an SSP in libcosim."""

import sys

import numpy as np
from libcosimpy._internal import get_last_error_message
from libcosimpy.CosimEnums import CosimVariableType
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
from libcosimpy.CosimObserver import CosimObserver


def main(ssp: str, step: float, end: float, out: str) -> None:
    log_output_level(CosimLogLevel.WARNING)
    execution = CosimExecution.from_ssp_file(ssp, step_size=round(step * 1e9))
    observer = CosimObserver.create_time_series(round(end / step) + 1)
    execution.add_observer(observer)
    bearings = {s.name.decode(): s.index for s in execution.slave_infos() if s.name != b"rotor"}
    watched = []
    for index in bearings.values():
        references = {v.name.decode(): v.reference for v in execution.slave_variables(index)}
        for name in ("wrench.Fx", "wrench.Fy"):
            watched.append((index, references[name]))
            observer.start_time_series(index, references[name], CosimVariableType.REAL)
    steps = round(end / step)
    if not execution.step(steps):
        print(get_last_error_message())
        sys.exit("libcosim: the run failed")
    series = [observer.time_series_real_samples(*v, from_step=1, sample_count=steps)[2] for v in watched]
    forces = np.array(series).T.reshape(steps, len(bearings), 2)
    np.savez(out, forces=forces, names=list(bearings))


if __name__ == "__main__":
    main(sys.argv[1], float(sys.argv[2]), float(sys.argv[3]), sys.argv[4])
