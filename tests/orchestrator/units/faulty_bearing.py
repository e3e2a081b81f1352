"""A bearing that works for some steps and then fails once, as the environment variable FAULT says."""

import ctypes
import math
import os
import signal
import sys
import time

from spring_bearing import OUTPUTS, SpringBearing

LONG = 12.0  # s; without a guard the run ends well
BEGIN = 0.0015  # s


class FaultyBearing(SpringBearing):
    failed = False

    def exit_initialization_mode(self):
        if os.environ.get("FAULT") == "start":
            time.sleep(LONG)
        super().exit_initialization_mode()

    def do_step(self, current_time, step_size):
        fault = os.environ.get("FAULT") if current_time >= BEGIN and not self.failed else None
        self.failed = self.failed or fault is not None
        if fault == "sleep":
            time.sleep(LONG)
        elif fault == "loop":
            end = time.monotonic() + LONG
            while time.monotonic() < end:
                pass
        elif fault == "lock":  # keeps Python's lock, as a native library does that is called with it
            ctypes.PyDLL(None).usleep(int(LONG * 1e6))
        elif fault == "os._exit":
            os._exit(0)
        elif fault == "exit":
            sys.exit(0)
        elif fault == "end":
            ctypes.pythonapi.Py_Exit(0)
        elif fault == "_exit":  # of C: past Python and all its guards
            ctypes.CDLL(None)._exit(0)
        elif fault == "signal":
            os.kill(os.getpid(), signal.SIGSEGV)
        elif fault == "folder":
            os.chdir("/")
            os.umask(0)
        done = super().do_step(current_time, step_size)
        if fault == "nan":
            self.values.update(dict.fromkeys(OUTPUTS, math.nan))
        if os.environ.get("FAULT") == "gap":
            self.values["h_min"] = math.nan
        if os.environ.get("FAULT") == "one gap" and current_time >= BEGIN:
            self.values["h_min"] = math.nan
        return done
