"""Places of the shaft without inertia, which the dynamics cannot do without: they get a trace of it.

What moves with the trace alone, far above all that a machine does, must not ring: in a run such a mode is
damped (`rotor_fmu.vibration.modal_shaft`), so that it follows its load as a massless spring does.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

TRACE = 1e-8
"""Of the shaft's mass, for n places n^2 times as much: where errors of the model and of rounding, which grows
with the fourth power of the frequency at a place, are alike."""

MOST = 1e-5
"""Of the shaft's mass, for any number of places."""


def trace_of(mass: sp.csr_array, stiffness: sp.csr_array, total: float) -> NDArray[np.float64] | None:
    """Inertia by which the mass matrix of one plane becomes positive definite, (2 N,); None where it is.

    Frequencies change by less than the share of the mass that is added, 1e-6 for ten places.

    Parameters
    ----------
    mass, stiffness : scipy.sparse.csr_array, (2 N, 2 N)
        Of one plane, order (deflection, slope) a node.
    total : float
        Mass of the shaft [kg].

    Raises
    ------
    ValueError
        If the shaft has no mass at all.
    """
    own: NDArray[np.float64] = mass.diagonal()
    bare = own <= 0.0
    if not bare.any():
        return None
    if not total > 0.0:
        raise ValueError("the shaft has no mass; allowed are shoulders, wheels or masses that have some")
    places = int((bare[0::2] | bare[1::2]).sum())
    each = total * min(TRACE * places**2, MOST) / places
    stiff = stiffness.diagonal()
    # A slope as much as swings with the deflection beside it.
    trace = np.column_stack([np.full(len(own) // 2, each), each * stiff[1::2] / stiff[0::2]]).ravel()
    return np.where(bare, trace, 0.0)
