"""What the paper states about its turbine train, and how far a figure here may be from it.

Source: the reference study of the blade fracture on a 68 m turbine train, section 5 ("Results")
with its Figures 5 to 9.  The paper gives rounded figures and trends; the tolerances are this
project's.  This is the only place where they are written.
"""

from __future__ import annotations

from dataclasses import dataclass

SECTION_STEADY = "section 5.1, Steady state: unbalance response"
SECTION_TRANSIENT = "section 5.2, Transient: abrupt blade failure"


@dataclass(frozen=True)
class Published:
    """A figure of the paper: SI units, share by which a figure here may differ, where the paper states it."""

    value: float
    tolerance: float
    source: str


FORCE_BEFORE = Published(1.8e6, 0.10, f"{SECTION_STEADY}; Figure 6")
SOMMERFELD_BEFORE = Published(4.3, 0.10, SECTION_STEADY)
GAP_MEAN = Published(100e-6, 0.10, f"{SECTION_STEADY}; Figure 7, top")
GAP_HARMONIC = Published(5e-6, 0.30, f"{SECTION_STEADY}; Figure 7, top")
GAP_V2_OVER_V1 = Published(15e-6, 0.30, f"{SECTION_STEADY}; Figure 7")
GAP_V3_OVER_V1 = Published(30e-6, 0.30, f"{SECTION_STEADY}; Figure 7")
AMPLITUDE_BEFORE = Published(0.3e-3, 0.20, f"{SECTION_STEADY}; Figure 8")
STRESS_BEFORE = Published(40e6, 0.20, f"{SECTION_STEADY}; Figure 9")
SOMMERFELD_AFTER = Published(7.7, 0.15, SECTION_TRANSIENT)
FORCE_RATIO = Published(3.0, 0.30, f"{SECTION_TRANSIENT}: 'underestimate the maximum forces by factor 3'")

# How the paper's words are read as requirements.
CENTRE_OPEN_SHARE = 0.10
"""The centre line is clearly open above this share of its mean gap before the fracture ..."""
CENTRE_OPEN_ROUGHNESS = 10.0
"""... and above this many times the composite roughness."""
OTHER_END_SHARE = 0.01
"""The least gap changes its axial position when each end of the bearing has it for this share of the time."""
MOMENT_SHARE = 0.05
"""Moments are significant from this share of force times width: the resultant lies that far off mid-plane."""

DEPTHS = ("v1", "v2", "v3")
"""What the paper compares."""
STRESS_LIMIT = 150e6
"""Nominal normal stress [Pa] from which a shaft is inspected: assumed, about half the rotating-bending
fatigue limit of a smooth bar of NiCrMoV rotor steel, for notches."""
