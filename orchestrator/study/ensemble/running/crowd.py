"""Many runs at once, on Dask: a cluster in this process that attends its runs, or any that there is."""

from __future__ import annotations

import contextlib
import itertools
import logging
import queue
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from itertools import islice
from typing import Any

from orchestrator.errors import OrchestratorError
from orchestrator.study.ensemble.running.attendant import attend, close_all, close_idle
from orchestrator.study.ensemble.running.bench import Work
from orchestrator.study.ensemble.running.row import DIED, Row

WAITING = 60.0
"""Time in s in which the first worker of a cluster must have come."""
_REFRESH = 2.0  # s, between two counts of the workers
CONNECTING = 10.0
"""Time in s in which a scheduler must answer."""
_TOGETHER = 0.2  # s, that a batch of short runs takes
_AHEAD = 4
_LEAST = 32  # runs that are handed over ahead, so that short ones do not wait for one another


class DaskMissingError(OrchestratorError):
    """A study cannot be run without Dask."""

    @property
    def exit_status(self) -> int:
        """That of an internal or file error."""
        return 1


def require_dask() -> None:
    """Raise DaskMissingError where Dask is not installed."""
    try:
        import distributed  # noqa: F401
    except ImportError:
        raise DaskMissingError(
            "a study needs the package distributed: pip install 'bladeloss[study]'"
        ) from None


class Crowd:
    """Workers at hand.

    Parameters
    ----------
    client : distributed.Client
        Of the cluster.
    limit : float
        Wall time in s that a run may take; 0 for any.
    """

    def __init__(self, client: Any, limit: float = 0.0) -> None:
        self._client = client
        self._limit = limit
        self._numbers = itertools.count()
        self._counted, self._threads = -float("inf"), 1

    @property
    def threads(self) -> int:
        """How many runs there can be at once."""
        if time.monotonic() - self._counted > _REFRESH:
            self._threads = max(1, sum(self._client.nthreads().values()))
            self._counted = time.monotonic()
        return self._threads

    def carry_out(
        self, runs: Iterable[tuple[str, Callable[[], Work]]], done: Callable[[str, Row], None]
    ) -> None:
        """Have runs done.

        Parameters
        ----------
        runs : iterable of tuple
            Names, each once, and what makes the work; made when it is about to be handed over.
        done : callable
            Gets name and row, in this thread, in the order in which they end.

        Raises
        ------
        OrchestratorError
            When the cluster is lost.
        """
        import cloudpickle

        ended: queue.SimpleQueue[tuple[_Batch, Any]] = queue.SimpleQueue()
        waiting, under_way = iter(runs), dict[str, Any]()
        apart: list[_Batch] = []  # of batches with which workers ended
        more, pace = True, _Pace()

        def hand_over(batch: _Batch) -> None:
            works = [work for _, work in batch]
            key = f"bladeloss-{batch[0][0]}-{len(batch)}-{next(self._numbers)}"
            future = self._client.submit(attend, works, self._limit, key=key, pure=False)
            under_way[key] = future
            future.add_done_callback(lambda f: ended.put((batch, f)))

        try:
            while more or apart or under_way:
                while (more or apart) and len(under_way) < max(_LEAST, _AHEAD * self.threads):
                    if not apart:
                        batch = [(n, cloudpickle.dumps(make())) for n, make in islice(waiting, pace.batch)]
                        more = bool(batch)
                        if not more:
                            break
                    else:
                        batch = apart.pop()
                    hand_over(batch)
                if not under_way:
                    break
                try:
                    batch, future = ended.get(timeout=0.2)
                except queue.Empty:
                    continue
                del under_way[future.key]
                rows = _rows_of(future)
                if rows is None and len(batch) > 1:
                    apart += [[item] for item in batch]
                    continue
                for (name, _), row in zip(batch, rows or [Row(DIED, _LOST)], strict=True):
                    pace.count(row)
                    done(name, row)
        finally:
            with suppress(Exception):
                self._client.cancel(list(under_way.values()), force=True)


_Batch = list[tuple[str, bytes]]
_LOST = "every worker that had the run ended"


class _Pace:
    """How many runs are handed over at once: one, or some where they are very short."""

    def __init__(self) -> None:
        self._count, self._spent = 0, 0.0

    def count(self, row: Row) -> None:
        """Count a run that has ended."""
        self._count += 1
        self._spent += row.timing.get("run", _TOGETHER)

    @property
    def batch(self) -> int:
        """Number of runs for the next batch."""
        if self._count < _LEAST:
            return 1
        return max(1, min(_LEAST, int(_TOGETHER * self._count / max(self._spent, 1e-9))))


def _rows_of(future: Any) -> list[Row] | None:
    """The rows of runs that have ended, however they did; None where all workers ended that had them."""
    from distributed import KilledWorker

    if future.status == "cancelled":
        raise OrchestratorError(
            "the scheduler is gone; what is done is kept, and the same command goes on from there"
        )
    try:
        rows: list[Row] = future.result()
        return rows
    except KilledWorker:
        return None
    except (ImportError, AttributeError) as error:
        raise OrchestratorError(
            f"a worker cannot run it: {error}; it needs this bladeloss installed"
        ) from None


@contextmanager
def crowd(scheduler: str | None, jobs: int, limit: float = 0.0) -> Iterator[Crowd]:
    """Workers of a cluster at an address, or `jobs` of this machine.

    Raises
    ------
    OrchestratorError
        When there is none at that address.
    """
    require_dask()
    import dask
    from distributed import Client, LocalCluster

    for name in ("distributed", "tornado.application"):
        logging.getLogger(name).setLevel(logging.CRITICAL)
    with contextlib.ExitStack() as stack:
        stack.enter_context(dask.config.set({"distributed.admin.tick.limit": "1h"}))
        if scheduler is None:
            cluster = stack.enter_context(
                LocalCluster(
                    n_workers=1,
                    threads_per_worker=jobs,
                    processes=False,  # runs have processes of their own, see attendant.py
                    dashboard_address="127.0.0.1:0",  # a study more is no clash of ports
                    memory_limit=0,
                )
            )
            stack.callback(close_all)
            yield Crowd(stack.enter_context(Client(cluster)), limit)
            return
        try:
            client = stack.enter_context(Client(scheduler, timeout=CONNECTING))
        except (OSError, ValueError) as error:
            reason = " ".join(str(error).split())
            raise OrchestratorError(f"--scheduler {scheduler}: no Dask scheduler there: {reason}") from None
        try:
            client.wait_for_workers(1, timeout=WAITING)
        except TimeoutError:
            raise OrchestratorError(
                f"--scheduler {scheduler}: has no workers, none came within {WAITING:.0f} s; start some with "
                f"dask worker {scheduler} --nthreads 1"
            ) from None
        stack.callback(_close_elsewhere, client)
        yield Crowd(client, limit)


def _close_elsewhere(client: Any) -> None:
    with suppress(Exception):
        client.run(close_idle)
