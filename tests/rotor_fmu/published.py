"""Rotors of the literature on bearings of given stiffness and damping, as train folders, and their answers.

Sources: Lalanne and Ferraris 1998, the three-disc rotor of their chapter on multi-rotors, with inputs and
frequencies as in code_aster's test V2.02.124; Friswell, Penny, Garvey and Lees 2010, *Dynamics of Rotating
Machines*, examples 5.9.1, 5.9.5 and 5.9.9.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

RPM = math.pi / 30.0


@dataclass(frozen=True)
class Rotor:
    """A rotor as printed: shaft of equal segments, discs (z, mass, I_d, I_p), bearings (z, K, C).

    Attributes
    ----------
    frequency : dict
        Damped frequencies [Hz] by speed [rev/min].
    """

    name: str
    shear_modulus: float
    youngs_modulus: float
    density: float
    diameter: float
    segments: tuple[float, ...]
    discs: tuple[tuple[float, float, float, float], ...]
    bearings: tuple[tuple[float, str, str], ...]
    frequency: dict[int, tuple[float, ...]]
    damping_ratio: tuple[float, ...] = ()

    def write(self, folder: Path, rpm: float) -> Path:
        """Write it as a train that runs at a speed [rev/min]; returns the folder."""
        folder.mkdir(parents=True)
        rows = [f"{length!r},{self.diameter!r},0.0,steel" for length in self.segments]
        head = "length,outer_diameter,inner_diameter,material"
        (folder / "shaft.csv").write_text("\n".join([head, *rows]) + "\n")
        poisson = self.youngs_modulus / (2.0 * self.shear_modulus) - 1.0
        text = f'name = "{self.name}"\nspeed = {max(rpm, 1.0) * RPM!r}\nbalance_grade = 0.0025\n'
        text += f"[materials.steel]\nyoungs_modulus = {self.youngs_modulus!r}\npoisson_ratio = {poisson!r}\n"
        text += f"density = {self.density!r}\n"
        for i, (z, stiffness, damping) in enumerate(self.bearings):
            text += f'[[bearing]]\nname = "b{i}"\nz = {z!r}\nstiffness = {stiffness}\ndamping = {damping}\n'
        for i, (z, mass, transverse, polar) in enumerate(self.discs):
            text += f'[[wheel]]\nname = "d{i}"\nz = {z!r}\nmass = {mass!r}\n'
            text += f"transverse_inertia = {transverse!r}\npolar_inertia = {polar!r}\n"
        (folder / "train.toml").write_text(text)
        return folder


LALANNE = Rotor(
    "lalanne", 2e11 / 2.6, 2e11, 7800.0, 0.1, (0.1,) * 13,
    ((0.2, 14.5801, 0.0646386, 0.123202), (0.5, 45.9458, 0.497746, 0.976348),
     (1.0, 55.135, 0.602349, 1.171618)),
    ((0.0, "[5e7, 7e7]", "[500, 700]"), (1.3, "[5e7, 7e7]", "[500, 700]")),
    {
        0: (60.615, 63.025, 169.496, 185.563, 329.605, 362.078, 529.333, 557.573),
        25000: (55.411, 67.197, 157.898, 193.639, 249.851, 407.463, 446.713),
    },
)  # fmt: skip

_DISCS = ((0.5, 32.58973, 0.178089, 0.329564), (1.0, 51.52526, 0.423581, 0.805082))

FRISWELL = Rotor(
    "friswell", 81.2e9, 211e9, 7810.0, 0.05, (0.25,) * 6, _DISCS, ((0.0, "1e6", "0"), (1.5, "1e6", "0")),
    {
        0: (13.7921, 13.7921, 43.6582, 43.6582, 114.0801, 114.0801),
        4000: (13.5902, 13.9731, 40.0728, 46.9051, 95.5215, 131.6331),
    },
)  # fmt: skip

DAMPED = Rotor(
    "friswell_damped", 81.2e9, 211e9, 7810.0, 0.05, (0.25,) * 6, _DISCS,
    ((0.0, "1e6", "3e3"), (1.5, "1e6", "3e3")),
    {4000: (13.6819, 14.0716, 41.9829, 50.6487, 104.2484, 105.6629)},
    (0.0474, 0.0535, 0.2704, 0.2404, 0.5236, 0.7089),
)  # fmt: skip

OVERHUNG = Rotor(
    "friswell_overhung", 81.2e9, 211e9, 7810.0, 0.05, (0.25,) * 6, ((1.5, 51.52526, 0.423581, 0.805082),),
    ((0.0, "1e7", "0"), (1.0, "1e7", "0")),
    {
        0: (14.3467, 14.3467, 100.3833, 100.3833, 132.1678, 132.1678),
        4000: (12.1260, 16.5376, 90.0802, 100.9415, 103.0924, 186.8793),
    },
)  # fmt: skip
