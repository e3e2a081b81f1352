"""``python -m orchestrator`` is the command ``bladeloss``."""

from orchestrator.cli import main

main()
