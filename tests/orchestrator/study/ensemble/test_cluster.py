"""A study on workers of others, one of which is killed: complete all the same; and ten thousand samples."""

import os
import resource
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest

pytest.importorskip("distributed", reason="studies run on Dask, which is not installed")

import bladeloss

from orchestrator.results.ensemble.files import RUNS
from tests.faults import fault
from tests.orchestrator.study.ensemble import functions

ROOT = Path(__file__).parents[4]


@pytest.fixture
def cluster(tmp_path):
    """Address of a scheduler, and its two workers, each a process of its own."""
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    place = tmp_path / "scheduler.json"
    command = [sys.executable, "-m", "distributed.cli."]

    def start(name, *options):
        line = [*command[:2], f"distributed.cli.{name}", "--scheduler-file", str(place), *options]
        return subprocess.Popen(line, cwd=ROOT, env=environment, stderr=subprocess.DEVNULL)

    few = ("--nthreads", "1", "--no-nanny", "--no-dashboard", "--local-directory", str(tmp_path))
    started = [start("dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard")]
    started += [start("dask_worker", *few) for _ in range(2)]
    try:
        from distributed import Client

        while not place.exists():
            time.sleep(0.1)
        with Client(scheduler_file=str(place), timeout=60) as client:
            client.wait_for_workers(2, timeout=120)
            address = client.scheduler.address
        yield address, started[1:]
    finally:
        for process in started:
            process.kill()
            process.wait()


@pytest.mark.slow
@fault(
    "process",
    "a worker of a study's cluster that is killed",
    "its runs are done by others; the study ends complete, each sample once",
    guard="orchestrator.study.ensemble.running.crowd:Crowd.carry_out",
)
def test_a_worker_may_be_killed(cluster, tmp_path):
    address, workers = cluster
    folder = tmp_path / "study"
    count = 120

    def kill():
        while len(list((folder / RUNS).glob("*.json"))) < count // 4:
            time.sleep(0.05)
        workers[0].send_signal(signal.SIGKILL)

    killer = threading.Thread(target=kill)
    killer.start()
    study = {"parameters": {"x": {"key": "x", "grid": {"start": 1.0, "stop": 120.0, "count": count}}}}
    data = bladeloss.study(study, function=functions.takes_its_time, scheduler=address, out=folder)
    killer.join()
    assert workers[0].wait(10.0) == -signal.SIGKILL and workers[1].poll() is None
    assert (data["outcome"] == "finished").all()
    np.testing.assert_array_equal(data["value"].values[:, 0], data["x"].values)
    assert len(list((folder / RUNS).glob("*.json"))) == count


@pytest.mark.slow
def test_ten_thousand_samples_take_less_than_two_minutes_and_two_gigabytes():
    """Of processor time of this process, which hands them over and gathers them."""
    study = {"parameters": {"x": {"key": "x", "grid": {"start": 0.0, "stop": 1.0, "count": 10_000}}}}
    begin = time.process_time()
    data = bladeloss.study(study, function=functions.total, jobs=2)
    assert time.process_time() - begin < 120.0
    assert float(data["total"].sum()) == pytest.approx(5000.0)
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss < 2e6  # kB
