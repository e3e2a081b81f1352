"""Grooves and fed pockets of the bore: given pressure, and what of the friction the force does not tell."""

from __future__ import annotations

from bearing_fmu.bore.bore import Bore
from bearing_fmu.films.tilted.rupture import TIE
from bearing_fmu.films.tilted.workspace import TiltedFilm
from bearing_fmu.kernels.compiled import inner_kernel
from bearing_fmu.result import ABSOLUTE, GAP


@inner_kernel
def _hold_pockets(film: TiltedFilm, bore: Bore, pressure: float) -> None:
    """Tie the nodes of fed pockets."""
    if bore is not None:
        n, m = film.face.shape[1], film.circle.shape[2]
        width = film.coupling.shape[0] // m
        b = film.blocks[0]
        for i in range(m):
            for j in range(n):
                if bore.fed[i] != 0.0 and abs(film.nodes[j]) <= bore.reach[0, i]:
                    at = (i * n + j) * width + j
                    tie = TIE * b[at]
                    b[at] += tie
                    film.sides[i * width + j] += tie * pressure


@inner_kernel
def hold_grooves(film: TiltedFilm, bore: Bore, pressure: float) -> None:
    """Hold the columns in grooves and the nodes in fed pockets at the feed pressure, over the ambient one."""
    _hold_pockets(film, bore, pressure)
    if bore is not None:
        n, m = film.face.shape[1], film.circle.shape[2]
        width = film.coupling.shape[0] // m
        b, coupling, sides = film.blocks[0], film.coupling, film.sides
        for i in bore.held:
            back = i - 1 if i > 0 else m - 1
            fore = i + 1 if i + 1 < m else 0
            b[i * n * width : (i + 1) * n * width] = 0.0
            for j in range(n):
                b[(i * n + j) * width + j] = 1.0
                sides[back * width + j] += coupling[back * width + j] * pressure
                sides[fore * width + j] += coupling[i * width + j] * pressure
                coupling[back * width + j] = 0.0
                coupling[i * width + j] = 0.0
        for i in bore.held:
            for j in range(n):
                sides[i * width + j] = pressure


@inner_kernel
def pressure_drag(film: TiltedFilm, bore: Bore) -> float:
    """Integral of H dp/dphi over the bearing part of the pressure; of a plain bore the force tells it."""
    total = 0.0
    if bore is not None:
        m = film.circle.shape[2]
        for j in range(film.face.shape[1]):
            above, gap, part = film.column[ABSOLUTE, j], film.face[GAP, j], 0.0
            for i in range(m):
                fore = i + 1 if i + 1 < m else 0
                part += bore.inside[1, i] * gap[i] * (max(above[fore], 0.0) - max(above[i], 0.0))
            total += film.weights[j] * part
    return total
