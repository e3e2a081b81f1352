"""The process that carries out runs one after another; it ends with the one that started it."""

from __future__ import annotations

import pickle
import queue
import sys
import threading
from multiprocessing.connection import Connection
from os import _exit  # units may put another in its place

from orchestrator.study.ensemble.running.bench import Bench
from orchestrator.study.ensemble.running.row import Row

HUNG = 12
"""Exit status where a unit does not come back."""


def main(descriptor: int) -> None:
    """Do the work that comes through a connection, and answer with its row, until that ends."""
    there = Connection(descriptor)
    todo: queue.SimpleQueue[bytes] = queue.SimpleQueue()

    def listen() -> None:
        while True:
            try:
                todo.put(there.recv_bytes())
            except (EOFError, OSError):
                _exit(0)

    def answer(row: Row) -> None:
        there.send_bytes(pickle.dumps(row))

    def give_up(row: Row) -> None:
        answer(row)
        _exit(HUNG)

    threading.Thread(target=listen, daemon=True).start()
    bench = Bench(give_up)
    there.send_bytes(b"ready")
    while True:
        try:
            answer(pickle.loads(todo.get()).carry_out(bench))
        except SystemExit as end:  # as Python would, but at once
            _exit(end.code if isinstance(end.code, int) else 1)


if __name__ == "__main__":
    main(int(sys.argv[1]))
