"""What a film gives, dimensionless, and where it lies in the array that its kernel fills.

Forces over `scales.force`, moments over that times b/2, lengths and velocities over the clearance, tilts
times b/2 over the clearance, the pressure over `scales.pressure`.
"""

from __future__ import annotations

#: Wrench (4), dF/dq and dF/dv row by row (16 each), largest pressure, integral of 1/T over the film,
#: in a bore with grooves of H dp/dphi, and the flow out at both ends over `scales.flow`.
WRENCH, STIFFNESS, DAMPING, PEAK, SHEAR, DRAG, FLOW, RESULTS = 0, 4, 20, 36, 37, 38, 39, 40

#: Fields at the nodes of the columns and of the faces: gap, gap open to the oil with two derivatives,
#: conductance and its power of the open gap; then at the columns the squeeze flow and the pressure over the
#: cavity.
GAP, OPEN, OPEN_1, OPEN_2, CONDUCTANCE, POWER, SQUEEZE, ABSOLUTE, FIELDS = range(9)
