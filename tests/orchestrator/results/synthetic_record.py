"""Made-up records with known statistics, shaped like real runs; for tests of what reads records."""

from __future__ import annotations

import itertools
import json

import numpy as np
import xarray as xr

from bearing_fmu.parameters import BearingParameters
from orchestrator.scenario.events import BladeLoss, to_json
from rotor_fmu.train.train import BearingSeat, Coupling, Material, Shoulder, Train, Wheel

SPEED = 2 * np.pi * 25.0
STEEL = Material("steel", 2.06e11, 0.3, 7850.0)
NAMES = (
    *("HP-front", "HP-rear", "LP1-front", "LP1-rear", "LP2-front", "LP2-rear"),
    *("LP3-front", "LP3-rear", "GEN-front", "GEN-rear", "EXC-rear"),
)
Z = (1.5, 8.5, 11.5, 20.5, 22.5, 31.5, 33.5, 42.5, 46.0, 61.0, 67.0)
CLEARANCE = 8.6e-4
FILM = BearingParameters(
    0.8, 0.64, CLEARANCE, 0.0242, roughness=3e-6, contact_modulus=1e9, columns=24, rows=4
)
FORCE = np.array([0.5, 0.6, 1.5, 1.75, 1.8, 1.7, 1.75, 1.5, 1.6, 1.4, 0.2]) * 1e6


def train() -> Train:
    """278 shoulders, 68 m, eleven bearings, LP bodies with wheels."""
    edges = np.linspace(0.0, 68.0, 279)
    shoulders = []
    for left, right in itertools.pairwise(edges):
        middle = (left + right) / 2
        near = min(abs(middle - z) for z in Z)
        outer = 0.8 if near < 0.8 else 1.05 if near < 1.4 else 1.5
        shoulders.append(Shoulder(right - left, 0.45 if middle > 62.5 else outer, 0.0, STEEL))
    wheels = []
    for body, (front, rear) in {
        "HP": (3.0, 7.0),
        "LP1": (13.5, 18.5),
        "LP2": (24.5, 29.5),
        "LP3": (35.5, 40.5),
    }.items():
        for j, z in enumerate(np.linspace(front, rear, 7), 1):
            diameter = (1.9 if body == "HP" else 2.2) + (0 if body == "HP" else 0.5 * abs(j - 4) / 3)
            wheels.append(Wheel(f"{body}-{j}", int(np.argmin(abs(edges - z))), 2e4, 1e4, 6e3, diameter))
    bearings = [
        BearingSeat(name, int(np.argmin(abs(edges - z))), 0.8, 0.64, CLEARANCE, 0.0242)
        for name, z in zip(NAMES, Z, strict=True)
    ]
    couplings = [Coupling(f"C{z:.0f}", int(np.argmin(abs(edges - z)))) for z in (10, 21.5, 32.5, 44.2, 62.5)]
    return Train(
        "synthetic",
        SPEED,
        0.5,
        1e-5,
        2.5e-3,
        tuple(shoulders),
        tuple(wheels),
        tuple(bearings),
        tuple(couplings),
    )


def record(
    depth: str = "v1",
    *,
    end: float = 2.0,
    fracture: float | None = 1.0,
    interval: float = 1e-3,
    seed: int = 1,
) -> xr.Dataset:
    """A record of the whole train; before the event everything is a mean plus one harmonic."""
    rng = np.random.default_rng(seed)
    t = np.arange(round(end / interval) + 1) * interval
    since = np.inf if fracture is None else fracture
    grown = np.where(t > since, 1 - np.exp(-np.maximum(t - since, 0) / 0.08), 0.0)
    beat = grown * (1 + 0.3 * np.cos(2 * np.pi * 1.25 * np.where(t > since, t - since, 0)))
    angle = SPEED * t
    violent = {"v1": 1.0, "v2": 0.45, "v3": 0.5}.get(depth, 0.5)
    gap_mean = {"v1": 100e-6, "v2": 115e-6, "v3": 130e-6}.get(depth, 130e-6)
    shape = np.exp(-(((np.asarray(Z) - 22.5) / 14.0) ** 2))
    near = shape[None, :, None]
    wave = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    half = np.stack([np.cos(angle / 2 + 0.4), np.sin(angle / 2 + 0.4)], axis=1)
    rough = rng.standard_normal((t.size, 2)) * (0.25 if depth == "v1" else 0.02)
    swing = 0.05 * wave + beat[:, None] * violent * (0.7 * wave + 0.5 * half + rough)
    force = np.array([0.0, 1.0])[None, None, :] * FORCE[None, :, None] + 1.8e6 * swing[:, None, :] * near
    moment = (0.03e6 * wave + 1.6e6 * beat[:, None] * (half + rough))[:, None, :] * near * (depth == "v1")
    lowest = {"v1": 1.05, "v2": 0.8, "v3": 0.5}.get(depth, 0.5)
    ripple = 0.5 + 0.5 * np.cos(angle + 0.3) * np.where(grown > 0, np.cos(angle / 2) ** 2, 1)
    gap = (
        gap_mean
        + 5e-6 * np.cos(angle)[:, None] * shape
        - (lowest * gap_mean * np.minimum(beat, 1.0) * ripple)[:, None] * shape
    )
    gap = np.maximum(gap, 2e-6)
    centre = gap + (15e-6 + 40e-6 * beat[:, None] * shape if depth == "v1" else 0.0)
    contact = np.where(gap < 8e-6, (8e-6 - gap) / 6e-6 * 0.9e6, 0.0)
    z = np.linspace(0.0, 68.0, 279)
    bow = np.sin(np.pi * z / 9.0) * np.exp(-(((z - 24.0) / 16.0) ** 2))
    static = np.stack([0.02e-3 * bow, -3e-3 * np.sin(np.pi * z / 68.0)], axis=1)
    dynamic = 0.3e-3 * (1 + 6 * beat * violent)
    deflection = static[None] + dynamic[:, None, None] * bow[None, :, None] * wave[:, None, :]
    amplitude = dynamic[:, None] * np.abs(bow)[None]
    stress = 38e6 * (0.6 + 0.4 * np.cos(np.pi * z / 4.5) ** 2)[None] + amplitude * 6e10
    field = ("time", "node")
    scalar = ("time", "bearing")
    size = np.hypot(force[..., 0], force[..., 1])
    jitter = 1 + 0.12 * rng.random(size.shape) * beat[:, None] * (depth == "v1")
    journal = 0.5 * CLEARANCE * (np.array([0.6, -0.8]) + 0.9 * swing[:, None, :] * near)
    seats = {"diameter": (0.8, "m"), "width": (0.64, "m"), "clearance": (CLEARANCE, "m")}
    seats |= {"viscosity": (0.0242, "Pa s"), "roughness": (3e-6, "m")}
    variables = {
        "displacement": ((*scalar, "axis"), journal),
        "offset": (("bearing", "axis"), np.zeros((len(NAMES), 2))),
        "tilt": ((*scalar, "axis"), np.zeros_like(journal)),
        "offset_tilt": (("bearing", "axis"), np.zeros((len(NAMES), 2))),
        "velocity": ((*scalar, "axis"), np.gradient(journal, t, axis=0)),
        "tilt_rate": ((*scalar, "axis"), np.zeros_like(journal)),
        "rotor_speed": ((), SPEED),
        "bearing_parameters": (("bearing",), [json.dumps(FILM.values())] * len(NAMES)),
        **{
            f"bearing_{name}": (("bearing",), np.full(len(NAMES), value))
            for name, (value, _) in seats.items()
        },
        "force": (("time", "bearing", "axis"), force),
        "moment": (("time", "bearing", "axis"), moment),
        "least_gap": (scalar, gap),
        "centre_line_gap": (scalar, centre),
        "contact_force": (scalar, contact),
        "sommerfeld": (scalar, size / 1.8e6 * 4.3),
        "force_magnitude_max": (scalar, size * jitter),
        "moment_magnitude_max": (scalar, np.hypot(moment[..., 0], moment[..., 1]) * jitter),
        "least_gap_min": (scalar, gap * 0.98),
        "centre_line_gap_min": (scalar, centre * 0.98),
        "contact_force_max": (scalar, contact * 1.02),
        "defect_max": (scalar, 1e-4 * size),
        "deflection": (("time", "node", "axis"), deflection),
        "static_line": (("node", "axis"), static),
        "amplitude": (field, amplitude),
        "stress": (field, stress),
        "vibration_amplitude_max": (("time",), amplitude.max(axis=1)),
        "vibration_amplitude_position": (("time",), z[amplitude.argmax(axis=1)]),
        "normal_stress_max": (("time",), stress.max(axis=1)),
        "normal_stress_position": (("time",), z[stress.argmax(axis=1)]),
    }
    units = {
        "force": "N",
        "moment": "N m",
        "contact_force": "N",
        "defect_max": "N",
        "sommerfeld": "1",
        "stress": "Pa",
    }
    units |= {f"bearing_{name}": unit for name, (_, unit) in seats.items()}
    variables = {
        name: (dims, values, {"units": units.get(name, "m"), "long_name": name.replace("_", " ")})
        for name, (dims, values) in variables.items()
    }
    attributes: dict[str, object] = {
        "title": "synthetic",
        "coupling": "linear-implicit",
        "macro_step": 1e-4,
        "speed": SPEED,
        "status": "finished",
    }
    if fracture is not None:
        attributes["fracture_time"] = fracture
        loss = BladeLoss(wheel="LP1-2", unbalance=265.0, time=fracture)
        attributes["events"] = to_json([loss])
    return xr.Dataset(
        variables,
        coords={
            "time": t,
            "bearing": list(NAMES),
            "axis": ["x", "y"],
            "z": ("node", z),
            "depth": ("bearing", [depth] * len(NAMES)),
            "bearing_z": ("bearing", list(Z)),
            "reynolds": ("bearing", [1950.0] * len(NAMES)),
            "taylor_limit": ("bearing", [888.0] * len(NAMES)),
            "laminar": ("bearing", [True] * len(NAMES)),
        },
        attrs=attributes,
    )
