"""Hold a record against the limits."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from orchestrator.results.film_regime import regimes
from orchestrator.results.geometry import bearing_value, in_housing
from orchestrator.results.least_damped import least_damped_of
from orchestrator.results.quantities import (
    FORCE,
    GAP,
    HERTZ,
    NUMBER,
    PRESSURE,
    RATIO,
    SHARE,
    STRESS,
    VIBRATION,
)
from orchestrator.results.signals.orders import (
    peak_to_peak_of_turns,
    probe_signals,
    running_peak_to_peak,
    turned_angle,
)
from orchestrator.results.statistics import (
    analysed_bearing,
    bearing_statistics,
    contact_threshold,
    shaft_statistics,
)
from orchestrator.results.verdicts.limits import ATTRIBUTE, Limits, ShaftVibration, limits_of, load_limits
from orchestrator.results.verdicts.verdict import Grade, Verdict, held, worst
from orchestrator.results.windows import Phase, Window, changing_speed, phases, speed_in

if TYPE_CHECKING:
    import xarray as xr
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]


def own_limits(record: xr.Dataset) -> Limits:
    """The limits that a run was given, or the usual ones."""
    text = record.attrs.get(ATTRIBUTE)
    return limits_of(str(text)) if text else load_limits()


def judge(record: xr.Dataset, limits: Limits) -> tuple[Verdict, ...]:
    """Hold every phase of a run at every bearing against every limit that is known.

    Parameters
    ----------
    record : xarray.Dataset
        With the geometry of its bearings, see `orchestrator.results.geometry`.
    limits : Limits
        From `orchestrator.results.verdicts.limits.load_limits`.
    """
    if record.sizes.get("time", 0) < 2:
        return ()
    found = phases(record)
    verdicts: list[Verdict] = []
    for name in map(str, record["bearing"].values):
        one = _Bearing.of(record, name, found)
        for phase in found:
            verdicts += one.verdicts(phase, limits)
    verdicts += _regimes(record, limits)
    verdicts += _stability(record, limits)
    if limits.stress is not None:
        verdicts += _stress(record, found, limits)
    return tuple(verdicts)


@dataclass(frozen=True)
class _Bearing:
    """One bearing of a record, with what all its verdicts need."""

    record: xr.Dataset
    name: str
    time: NDArray[np.float64]
    diameter: float
    area: float
    contact_from: float

    @classmethod
    def of(cls, record: xr.Dataset, name: str, found: tuple[Phase, ...]) -> _Bearing:
        diameter, width = (bearing_value(record, key, name) for key in ("diameter", "width"))
        time = np.asarray(record["time"].values, dtype=float)
        threshold = contact_threshold(record, name, found)
        return cls(record, name, time, diameter, diameter * width, threshold)

    def verdicts(self, phase: Phase, limits: Limits) -> Iterator[Verdict]:
        """In one phase: film, load, contact, vibration."""
        found = bearing_statistics(self.record, self.name, phase, contact_from=self.contact_from)
        place = phase.name, self.name
        bore = not math.isnan(found.least_gap_min)  # else stiffness and damping are all that is known
        if bore and (film := limits.least_film) is not None:
            bound = film.at(self.diameter, speed_in(self.record, phase.peak) * self.diameter / 2.0)
            gap, when = found.least_gap_min, self._when("least_gap_min", phase, least=True)
            share = bound / gap if gap > 0.0 else math.inf
            yield held(film, "least film", place, GAP, gap, bound, share=share, instant=when)
        if bore and (load := limits.specific_load) is not None:
            lasting, short = found.force_mean / self.area, found.force_max / self.area
            when = self._when("force_magnitude_max", phase)
            yield held(load, "specific load, lasting", place, PRESSURE, lasting, load.steady)
            yield held(load, "specific load, short", place, PRESSURE, short, load.short, instant=when)
        if (contact := limits.contact) is not None and found.contact_max > self.contact_from:
            note = f"{100.0 * found.contact_share:.0f} % of the time, first at {found.contact_first:.4f} s"
            when, force = self._when("contact_force_max", phase), found.contact_max
            yield held(
                contact, "solid contact", place, FORCE, force, 0.0, note=note, instant=when, trips=True
            )
        if (wiped := limits.wiped) is not None and found.wiped_max > wiped.largest:
            note = f"{100.0 * found.wiped_max:.2g} % of the bore yields"
            when, most, allowed = self._when("wiped_max", phase), found.wiped_max, wiped.largest
            yield held(wiped, "wiped bore", place, SHARE, most, allowed, note=note, instant=when)
        if (vibration := limits.shaft_vibration) is not None and "displacement" in self.record:
            yield self._vibration(phase, vibration)

    def _vibration(self, phase: Phase, limit: ShaftVibration) -> Verdict:
        """Largest peak to peak over a revolution at the probes; lasting where nothing happens.

        Where the speed changes, each revolution is held against the bounds at its own speed.
        """
        window = phase.peak if phase.name.startswith("after") else phase.mean
        times, speeds, angles, swing = self._swings(window, limit.probes)
        shares = swing / np.interp(speeds, limit.speed, limit.zone_cd)
        probe, at = np.unravel_index(int(np.argmax(shares)), swing.shape)
        value, (a_b, b_c, c_d) = float(swing[probe, at]), limit.at(float(speeds[at]))
        zone = "ABCD"[sum(value > bound for bound in (a_b, b_c, c_d))]
        bounds = "/".join(VIBRATION.number(bound) for bound in (a_b, b_c, c_d))
        angle = math.degrees(angles[probe])
        note = f"zone {zone} of {bounds} {VIBRATION.unit}, probe at {angle:.0f}°"
        grade = {"C": Grade.CLOSE, "D": Grade.BEYOND}.get(zone, Grade.WITHIN)
        when, place = float(times[at]), (phase.name, self.name)
        words = "shaft vibration, peak to peak"
        found = held(limit, words, place, VIBRATION, value, c_d, note=note, instant=when, trips=True)
        return replace(found, grade=grade)

    def _swings(
        self, window: Window, probes: tuple[float, ...]
    ) -> tuple[Floats, Floats, tuple[float, ...], Floats]:
        """Instants, speeds there, angles of the probes, and peak to peak over the revolution around each.

        Of records too far apart for it the revolutions that a run has kept are taken, along x and y.
        """
        inside = window.mask(self.time)
        time, changing = self.time[inside], changing_speed(self.record)
        speed = np.full(time.size, speed_in(self.record, window)) if changing is None else changing[inside]
        step = (self.time[-1] - self.time[0]) / (self.time.size - 1)
        if step * speed.max() > 0.5 * math.pi and "revolution_overall" in self.record:
            ends = np.asarray(self.record["revolution"].values, dtype=float)
            if (kept := window.mask(ends)).any():
                overall = self.record["revolution_overall"].sel(bearing=self.name)
                of_axes = overall.transpose("axis", "revolution").values[:, kept]
                speeds = self.record["revolution_speed"].values[kept]
                return ends[kept], speeds, (0.0, 0.5 * math.pi), of_axes
        journal = in_housing(self.record).sel(bearing=self.name)
        signals = probe_signals(journal.transpose("axis", "time").values[:, inside], probes)
        if changing is None:
            turn = round(2.0 * math.pi / speed[0] / step) + 1
            return time, speed, probes, running_peak_to_peak(signals, turn)
        return time, speed, probes, peak_to_peak_of_turns(signals, turned_angle(time, speed))

    def _when(self, name: str, phase: Phase, *, least: bool = False) -> float | None:
        """Instant of a phase's extreme."""
        if name not in self.record:
            return None
        values = self.record[name].sel(bearing=self.name).values
        inside = np.flatnonzero(phase.peak.interval_mask(self.time))
        if not inside.size:
            return None
        chosen = values[inside]
        return float(self.time[inside[int(np.argmin(chosen) if least else np.argmax(chosen))]])


def _regimes(record: xr.Dataset, limits: Limits) -> Iterator[Verdict]:
    """Whether films that are taken as laminar are: the limit of a model, not of a machine."""
    limit = limits.laminar_film
    if limit is None:
        return
    for film in regimes(record):
        place = "all", film.bearing
        found = held(limit, "laminar film, Re", place, NUMBER, film.reynolds, film.taylor)
        if not film.laminar:
            found = replace(found, grade=Grade.WITHIN, note="turbulence is in the film")
        elif film.beyond:
            found = replace(found, grade=Grade.CLOSE, note="beyond laminar theory")
        yield found


def _stability(record: xr.Dataset, limits: Limits) -> Iterator[Verdict]:
    """The least damped mode where the train runs."""
    limit, mode = limits.log_decrement, least_damped_of(record)
    if limit is not None and mode is not None:
        value = float(mode.log_decrement)
        share = limit.least / value if value > 0.0 else math.inf
        note = f"{mode.frequency / HERTZ:.2f} Hz" + ("" if mode.stable else ", unstable")
        yield held(limit, "log decrement", ("all", ""), RATIO, value, limit.least, share=share, note=note)


def _stress(record: xr.Dataset, found: tuple[Phase, ...], limits: Limits) -> Iterator[Verdict]:
    limit = limits.stress
    assert limit is not None
    time = np.asarray(record["time"].values, dtype=float)
    for phase in found:
        row = shaft_statistics(record, phase)
        inside = phase.peak.mask(time)
        when = float(time[inside][int(np.argmax(record["normal_stress_max"].values[inside]))])
        note = f"at z = {row.stress_position:.1f} m"
        place = phase.name, ""
        yield held(
            limit, "normal stress", place, STRESS, row.stress_max, limit.largest, note=note, instant=when
        )


def worst_bearing(records: Sequence[xr.Dataset]) -> str:
    """The bearing to be looked at: that which runs name, that with the worst verdict, the most loaded one."""
    named = records[0].attrs.get("analysed_bearing")
    if not named:
        known = [record for record in records if "bearing_diameter" in record]
        judged = (v for record in known for v in judge(record, own_limits(record)) if v.bearing)
        found = [v for v in worst(judged) if v.grade is Grade.BEYOND]
        if found:
            return found[0].bearing
    return analysed_bearing(records[0], named)
