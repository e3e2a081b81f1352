"""A free shaft condensed onto its journals, statically or for one harmonic.

A u = f + B.T w, B u = q: the (static or dynamic) stiffness A of the free shaft is
singular or nearly so, and w comes from outside.  With reference springs r at the
journals,

    (A + B.T r B) u = f + B.T w',   w' = w + r q,

is regular and is solved once, for f and for the columns of B.T.  Prescribed
journals q, or an affine law w = F0 - K q, then cost one solve in the 4 n_b wrench
components (Sherman, Morrison and Woodbury); the result does not depend on r.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Generic, TypeVar

import numpy as np
import scipy.linalg
from numpy.typing import NDArray

from rotor_fmu.shaft.banded import lower_band
from rotor_fmu.shaft.matrices import ShaftModel

Array = NDArray[np.float64]
Scalar = TypeVar("Scalar", np.float64, np.complex128)

REFERENCE_FREQUENCY = 10.0
"""Of the shaft's mass on the static reference springs [rad/s]: between weak and oil-film springs."""

_LEAST_CONDITION = 1e-11
"""Reciprocal condition below which a shaft counts as not held; rounding leaves a free one about 1e-12."""


@dataclass(frozen=True, eq=False)
class Equilibrium(Generic[Scalar]):
    """Displacements u (n,) of a shaft, of its journals q (4 n_b,), and the wrenches w (4 n_b,) on them."""

    shape: NDArray[Scalar]
    journals: NDArray[Scalar]
    wrench: NDArray[Scalar]

    @cached_property
    def journals_at_rest(self) -> NDArray[Scalar]:
        """Displacements of the journals and their velocities, which are 0, (n_b, 8)."""
        positions = self.journals.reshape(-1, 4)
        return np.hstack([positions, np.zeros_like(positions)])

    @cached_property
    def bearing_wrenches(self) -> NDArray[Scalar]:
        """The wrenches, a row a bearing, (n_b, 4)."""
        return self.wrench.reshape(-1, 4)


@dataclass(frozen=True, eq=False)
class CondensedShaft(Generic[Scalar]):
    """Responses of the shaft on its reference springs.

    Attributes
    ----------
    shape_load, shape_wrench : ndarray, (n,), (n, 4 n_b)
        u from the load f, and from unit w'.
    journal_load, journal_wrench : ndarray, (4 n_b,), (4 n_b, 4 n_b)
        q likewise.
    reference : ndarray, (4 n_b,)
        Reference springs r.
    """

    shape_load: NDArray[Scalar]
    shape_wrench: NDArray[Scalar]
    journal_load: NDArray[Scalar]
    journal_wrench: NDArray[Scalar]
    reference: NDArray[Scalar]

    def at_positions(self, journals: NDArray[Scalar]) -> Equilibrium[Scalar]:
        """Equilibrium with prescribed journals q, (4 n_b,)."""
        return self._under(
            solve_held(self.journal_wrench, journals - self.journal_load, "prescribed journals")
        )

    def under_law(self, F0: NDArray[Scalar], K: NDArray[Scalar]) -> Equilibrium[Scalar]:
        """Equilibrium under w = F0 - K q.

        Parameters
        ----------
        F0 : ndarray, (4 n_b,)
            Constant part of the wrenches.
        K : ndarray, (n_b, 4, 4)
            Stiffness of each bearing.

        Returns
        -------
        Equilibrium
            Shape, journals and wrenches.

        Raises
        ------
        ValueError
            If the stiffness leaves a rigid-body motion of the shaft free.
        """
        loads, size = len(F0), self.journal_wrench
        # w' = F0 - (K - r) q with q = journal_load + journal_wrench w'.
        beyond = K.copy()
        beyond[:, range(4), range(4)] -= self.reference.reshape(-1, 4)
        blocks = len(K)
        matrix = (beyond @ size.reshape(blocks, 4, loads)).reshape(loads, loads)
        matrix[np.diag_indices(loads)] += 1.0
        rhs = F0 - (beyond @ self.journal_load.reshape(blocks, 4, 1)).ravel()
        return self._under(solve_held(matrix, rhs, "stiffness K of the affine laws"))

    def _under(self, load: NDArray[Scalar]) -> Equilibrium[Scalar]:
        journals = self.journal_load + self.journal_wrench @ load
        shape = self.shape_load + self.shape_wrench @ load
        return Equilibrium(shape, journals, load - self.reference * journals)


def condense_static(model: ShaftModel, gravity: float) -> CondensedShaft[np.float64]:
    """The unreduced shaft at rest under its weight.

    Parameters
    ----------
    model : ShaftModel
        The unreduced shaft.
    gravity : float
        [m/s2].

    Returns
    -------
    CondensedShaft
        Of the n displacements of the unreduced shaft.
    """
    reference = reference_springs(model, REFERENCE_FREQUENCY)
    dofs = model.bearing_dofs.ravel()
    loads = np.zeros((model.size, 1 + len(dofs)))
    loads[:, 0] = gravity * model.gravity
    loads[dofs, 1 + np.arange(len(dofs))] = 1.0
    band = lower_band(model.K)
    np.add.at(band[0], dofs, reference)
    shapes = scipy.linalg.solveh_banded(band, loads, lower=True)
    return condensed(shapes, shapes[dofs], reference)


def condensed(
    shapes: NDArray[Scalar], journals: NDArray[Scalar], reference: NDArray[Scalar]
) -> CondensedShaft[Scalar]:
    """The shaft of its responses, (n, 1 + 4 n_b), to the load and unit wrenches, and of their journals."""
    load, wrench = np.ascontiguousarray(shapes[:, 0]), np.ascontiguousarray(shapes[:, 1:])
    return CondensedShaft(load, wrench, journals[:, 0], np.ascontiguousarray(journals[:, 1:]), reference)


def reference_springs(model: ShaftModel, frequency: float) -> Array:
    """Reference springs on which the shaft's mass would swing at `frequency`, (4 n_b,)."""
    count = len(model.bearing_dofs)
    across = np.zeros(model.size)
    across[0::4] = 1.0
    radial = float(across @ (model.M @ across)) / count * frequency**2
    arm = (model.z[-1] - model.z[0]) / count or 1.0
    return np.tile([radial, radial, radial * arm**2, radial * arm**2], count)


def solve_held(matrix: NDArray[Scalar], rhs: NDArray[Scalar], what: str) -> NDArray[Scalar]:
    """Solve, refusing a matrix that is singular to working precision."""
    scale = np.abs(matrix).max(axis=1, keepdims=True)
    if not (np.all(np.isfinite(matrix)) and np.all(scale > 0.0)):
        raise ValueError(f"{what}: not finite, or a zero row; the shaft is not held")
    scaled, right = matrix / scale, (rhs.T / scale.ravel()).T
    factor, pivots, info = scipy.linalg.lapack.get_lapack_funcs(("getrf",), (scaled,))[0](scaled)
    norm = np.abs(scaled).sum(axis=0).max()
    reciprocal, _ = scipy.linalg.lapack.get_lapack_funcs(("gecon",), (scaled,))[0](factor, norm)
    if info != 0 or not reciprocal > _LEAST_CONDITION:
        raise ValueError(
            f"{what}: the shaft is not held (reciprocal condition {reciprocal:.1e}); "
            "allowed are laws whose stiffness leaves no rigid-body motion free"
        )
    return scipy.linalg.lu_solve((factor, pivots), right)
