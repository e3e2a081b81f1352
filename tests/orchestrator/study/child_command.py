"""Stands in for ``bladeloss run`` as a child: ``python -m ... HOW... --out FOLDER`` does what HOW says."""

import json
import os
import signal
import sys
import time
from pathlib import Path

COMMAND = (sys.executable, "-m", "tests.orchestrator.study.child_command")


def write(folder: Path, outcome: str, message: str = "", simulated: float = 0.3) -> None:
    folder.mkdir()
    told = {"outcome": outcome, "message": message, "simulated": simulated, "timing": {"loop": 1.0}}
    (folder / "summary.json").write_text(json.dumps(told))


def main(how: str, folder: Path) -> int:
    print("time loop ...", flush=True)
    print("  50 %  0.150 of 0.3 s", flush=True)
    if how == "killed":
        write(folder.with_name(f"{folder.name}-partial"), "interrupted", simulated=0.1)
        os.kill(os.getpid(), signal.SIGKILL)
    if how == "crashes":
        sys.exit("Fatal: out of luck")  # exit status 1
    if how == "exits":
        return 77
    if how == "refuses":
        print("error: short.toml: bearing = 'middle': no such bearing", file=sys.stderr)
        return 2
    if how == "cannot-write":
        print(f"error: not-written (exit status 13): {folder}: File too large. Make room.", file=sys.stderr)
        return 13
    if how == "counts":
        mark = folder.with_name(f"{folder.name}-running")
        mark.mkdir()
        time.sleep(0.3)
        count = len(list(folder.parent.glob("*-running")))
        mark.rmdir()
        (folder.parent / f"{folder.name}-count").write_text(str(count))
    if how == "waits":
        asked = []
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, lambda number, _frame: asked.append(number))
        print("listening ...", flush=True)
        while not asked:
            time.sleep(0.02)
        status, outcome = (143, "terminated") if asked == [signal.SIGTERM] else (130, "interrupted")
        write(folder.with_name(f"{folder.name}-partial"), outcome, "at t = 0.1 s", simulated=0.1)
        return status
    write(folder, "finished")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], Path(sys.argv[-1])))
