"""A run with units of others goes on in a child of its process, whose parent knows how it ended.

A native library may end its process with ``_exit(0)`` of C, past all guards inside: to a script that is
a run that went well.  The parent loads no unit.  It passes signals on, and takes the child's status from the
child's own last word; without one the run is lost, whatever the status says.
"""

from __future__ import annotations

import ctypes
import os
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import NoReturn

from orchestrator.outcome import PROCESS_DIED

_SIGNALS = {signal.SIGINT, signal.SIGTERM} | ({signal.SIGHUP} if hasattr(signal, "SIGHUP") else set())
_PARENT_DEATH_SIGNAL = 1  # PR_SET_PDEATHSIG of prctl, Linux


class _State:
    """Whether this process is a command's own, and where its parent waits for its last word."""

    is_command = False
    last_word: int | None = None


@contextmanager
def command() -> Iterator[None]:
    """Mark the process as a command's own, which alone may part in two; `SystemExit` is its last word."""
    _State.is_command = True
    status = 1
    try:
        yield
        status = 0
    except SystemExit as end:
        status = end.code if isinstance(end.code, int) else int(end.code is not None)
        raise
    finally:
        _State.is_command = False
        if _State.last_word is not None:
            with suppress(OSError):
                os.write(_State.last_word, bytes([status & 0xFF]))


def part() -> None:
    """Go on in a child process, where there is `os.fork`, before units of others are loaded.

    Returns in the child; the parent ends with the child's status, or that of a process that died.
    """
    if not _State.is_command or not hasattr(signal, "sigwaitinfo"):
        return
    _State.is_command = False
    sys.stdout.flush()
    sys.stderr.flush()
    listen, say = os.pipe()
    before = signal.pthread_sigmask(signal.SIG_BLOCK, _SIGNALS | {signal.SIGCHLD})
    parent, child = os.getpid(), os.fork()
    if child:
        os.close(say)
        _wait(child, listen)
    os.close(listen)
    _State.last_word = say
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(_PARENT_DEATH_SIGNAL, signal.SIGTERM)
        if os.getppid() != parent:  # it was killed meanwhile
            os.kill(os.getpid(), signal.SIGTERM)
    signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _wait(child: int, listen: int) -> NoReturn:
    """Pass signals on until the child has ended, and end as it said."""
    while True:
        found = signal.sigwaitinfo(_SIGNALS | {signal.SIGCHLD})
        if found.si_signo != signal.SIGCHLD:
            if found.si_code <= 0:  # of a process; what the terminal sends, the child has got, too
                os.kill(child, found.si_signo)
            continue
        ended, status = os.waitpid(child, os.WNOHANG)
        if ended:
            break
    word = os.read(listen, 1)
    if word:
        os._exit(word[0])
    code = os.waitstatus_to_exitcode(status)
    if code > 0:
        os._exit(code)
    how = f"by signal {-code}" if code else "with status 0"
    with suppress(OSError):
        os.write(2, f"error: a unit ended the process of the run {how}; there are no results\n".encode())
    os._exit(PROCESS_DIED)
