"""bladeloss from Python: run a scenario, read its results, judge and report them.

Everything returns plain data (`xarray.Dataset`, frozen dataclasses); SI units and rad. What is wrong with
the input is raised as `Error` with the words of the command line, a run that does not reach its end as
`RunError` with what it has. Examples: ``orchestrator/python/README.md``.
"""

from bladeloss.machines import bearing, modes, train
from bladeloss.results import conclusion, load, report, verdicts
from bladeloss.runs import RunError, run, scenario
from bladeloss.studies import study
from orchestrator.errors import OrchestratorError as Error
from orchestrator.results.signals.envelope import envelope
from orchestrator.results.signals.orders import (
    from_probes,
    order_amplitudes,
    probe_signals,
    running_peak_to_peak,
    whirl_of,
)
from orchestrator.results.signals.spectrum import spectrum, waterfall
from orchestrator.results.windows import phases

__all__ = [
    "Error",
    "RunError",
    "bearing",
    "conclusion",
    "envelope",
    "from_probes",
    "load",
    "modes",
    "order_amplitudes",
    "phases",
    "probe_signals",
    "report",
    "run",
    "running_peak_to_peak",
    "scenario",
    "spectrum",
    "study",
    "train",
    "verdicts",
    "waterfall",
    "whirl_of",
]
