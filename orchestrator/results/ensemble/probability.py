"""How likely something is, from how often it happened."""

from __future__ import annotations

from scipy.stats import beta

LEVEL = 0.95
"""Confidence of the bounds."""


def clopper_pearson(hits: int, count: int, unknown: int = 0, level: float = LEVEL) -> tuple[float, float]:
    """Bounds of a probability, of which `hits` out of `count` independent trials are known.

    Parameters
    ----------
    hits, count : int
        Trials in which it happened; all trials.
    unknown : int
        Trials of `count`, not among `hits`, of which it is not known: the lower bound takes them as misses,
        the upper one as hits.
    level : float
        Confidence.

    Returns
    -------
    tuple of float
        Lower and upper bound: Clopper and Pearson (1934), Biometrika 26, 404; never too narrow, also where
        the trials are stratified, as in a Latin hypercube.
    """
    tail = (1.0 - level) / 2.0
    most = hits + unknown
    low = 0.0 if hits == 0 else float(beta.ppf(tail, hits, count - hits + 1))
    high = 1.0 if most >= count else float(beta.ppf(1.0 - tail, most + 1, count - most))
    return low, high
