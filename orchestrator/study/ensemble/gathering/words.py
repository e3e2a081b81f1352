"""What a study says at its end, in a few lines."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

import numpy as np
import xarray as xr

from orchestrator.results.ensemble.figures import CONTACT
from orchestrator.results.ensemble.probability import clopper_pearson
from orchestrator.study.ensemble.running.row import NOT_REFINED


def conclusions(data: xr.Dataset) -> Iterator[str]:
    """Yield how the runs ended at each depth, and how likely contact is over all samples."""
    for depth in data["depth"].values:
        at = data.sel(depth=depth)
        ended = Counter(str(outcome) for outcome in at["outcome"].values)
        ended.pop(NOT_REFINED, None)
        said = ", ".join(
            f"{count} {outcome}" for outcome, count in sorted(ended.items(), key=lambda i: (-i[1], i[0]))
        )
        text = f"{depth}: {said}" if depth else said
        if CONTACT in at:
            known = at[CONTACT].values[(at["outcome"] == "finished").values & np.isfinite(at[CONTACT].values)]
            count = sum(ended.values())
            low, high = clopper_pearson(int(known.sum()), count, count - known.size)
            bounds = f"95 %: {100 * low:.1f} to {100 * high:.1f} %"
            text += f"; solid contact in {int(known.sum())} of {count} ({bounds})"
        yield text
