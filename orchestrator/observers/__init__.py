"""What watches a run while it goes: recorder, ledger, checkpoints."""
