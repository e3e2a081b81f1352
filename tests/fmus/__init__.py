"""Tests of the FMI side."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))  # the spring unit must be a package of its own
