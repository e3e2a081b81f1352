"""Spectra, orders, probes and envelopes against signals whose answer is known."""

import numpy as np
import pytest
from scipy.signal import chirp

from orchestrator.results.signals.envelope import envelope
from orchestrator.results.signals.orders import (
    from_probes,
    order_amplitudes,
    peak_to_peak_of_turns,
    probe_signals,
    running_peak_to_peak,
    tracked_order,
    turned_angle,
    whirl_of,
)
from orchestrator.results.signals.spectrum import evenly, order_spectrum, spectrum, waterfall

SPEED = 2 * np.pi * 25.0
STEP = 5e-4
TIME = np.arange(1600) * STEP  # twenty revolutions
TONES = {0.5: 40e-6 * np.exp(0.3j), 1.0: 120e-6 * np.exp(-1.1j), 2.0: 7e-6 * np.exp(2.0j)}


def signal(time, tones=TONES, mean=3e-4):
    return mean + sum((a * np.exp(1j * k * SPEED * time)).real for k, a in tones.items())


@pytest.mark.parametrize("window", ["hann", "flattop", "boxcar"])
def test_a_spectrum_reads_the_amplitude_of_every_tone_and_nothing_else(window):
    found = spectrum(TIME, signal(TIME), window=window)
    order = found.frequency / 25.0
    for k, a in TONES.items():
        at = int(np.argmin(abs(order - k)))
        assert order[at] == pytest.approx(k, abs=1e-12)
        assert found.amplitude[at] == pytest.approx(abs(a), rel=1e-6)
    away = np.min([abs(order - k) for k in TONES], axis=0) > 0.25
    assert found.amplitude[away].max() < 1e-6 * 120e-6


def test_the_lines_at_zero_and_at_half_the_sampling_rate_are_not_doubled():
    values = np.where(np.arange(64) % 2, -2.0, 2.0) + 5.0
    found = spectrum(np.arange(64.0), values, window="boxcar")
    assert found.amplitude[-1] == pytest.approx(2.0, rel=1e-12)
    assert abs(found.amplitude[:-1]).max() < 1e-12


@pytest.mark.parametrize(
    ("window", "cosines"),
    [("hann", [0.5, 0.5]), ("flattop", [0.21557895, 0.41663158, 0.277263158, 0.083578947, 0.006947368])],
)
def test_a_tone_between_two_lines_reads_what_the_window_leaves_of_it(window, cosines):
    """Of sum (-1)^k a_k cos(2 pi k n / N) half a line off: sinc(1/2) sum (-1)^k a_k d2/(d2 - k2) / a_0."""
    left = sum((-1) ** k * a * 0.25 / (0.25 - k * k) for k, a in enumerate(cosines)) / cosines[0]
    tone = np.cos(2 * np.pi * 200.5 / (1600 * STEP) * TIME)
    assert spectrum(TIME, tone, window=window).amplitude.max() == pytest.approx(np.sinc(0.5) * left, rel=1e-4)


def test_uneven_samples_are_put_on_even_instants():
    time = np.array([0.0, 1.0, 1.5, 3.0, 4.0])
    step, values = evenly(time, 2.0 * time + 1.0)
    assert step == 1.0
    np.testing.assert_allclose(values, 2.0 * np.arange(5) + 1.0)


def test_orders_come_out_with_amplitude_and_phase_from_any_span_and_from_uneven_samples():
    time = np.sort(np.random.default_rng(1).uniform(0.01, 0.0777, 300))
    both = np.stack([signal(time), -2.0 * signal(time)], axis=-1)
    found = order_amplitudes(time, both, SPEED, list(TONES))
    expected = np.array(list(TONES.values()))
    np.testing.assert_allclose(found, expected[:, None] * [1.0, -2.0], rtol=1e-6)


@pytest.mark.parametrize("inclination", [-1.2, 0.0, 0.7])
@pytest.mark.parametrize("minor", [-30e-6, 30e-6])
def test_an_ellipse_gives_its_half_axes_its_inclination_and_its_sense(inclination, minor):
    turn = np.exp(1j * inclination) * (
        90e-6 * np.cos(SPEED * TIME + 0.4) + 1j * minor * np.sin(SPEED * TIME + 0.4)
    )
    x, y = order_amplitudes(TIME, np.stack([turn.real, turn.imag], axis=-1), SPEED, [1.0])[0]
    orbit = whirl_of(x, y)
    assert orbit.major == pytest.approx(90e-6, rel=1e-6)
    assert orbit.minor == pytest.approx(minor, rel=1e-6)
    assert orbit.inclination == pytest.approx(inclination, abs=1e-6)


def test_probes_read_their_direction_and_give_the_motion_back():
    x, y = 50e-6 * np.cos(SPEED * TIME), 20e-6 * np.sin(SPEED * TIME)
    angles = np.radians([45.0, 135.0, 200.0])
    read = probe_signals([x, y], angles)
    # in an ellipse that lies along x and y, a probe at a reads the amplitude sqrt(a^2 cos^2 + b^2 sin^2)
    amplitude = abs(order_amplitudes(TIME, read.T, SPEED, [1.0])[0])
    expected = np.hypot(50e-6 * np.cos(angles), 20e-6 * np.sin(angles))
    np.testing.assert_allclose(amplitude, expected, rtol=1e-6)
    np.testing.assert_allclose(from_probes(read, angles), [x, y], atol=1e-18)


def test_peak_to_peak_of_each_revolution():
    beat = (1.0 + 0.5 * np.sin(SPEED / 10 * TIME)) * np.cos(SPEED * TIME)
    found = running_peak_to_peak(beat, 80)
    assert found.max() == pytest.approx(np.ptp(beat), rel=2e-2)
    assert running_peak_to_peak(3e-6 * np.cos(SPEED * TIME), 81)[80:-80].min() == pytest.approx(
        6e-6, rel=1e-6
    )


def test_the_waterfall_of_a_chirp_climbs_along_its_frequency():
    time = np.arange(8000) * 2.5e-4
    found = waterfall(time, 4e-5 * chirp(time, 20.0, 2.0, 220.0), 0.1, slices=40, window="flattop")
    assert found.amplitude.shape == (40, 201)
    ridge = found.frequency[found.amplitude.argmax(axis=1)]
    assert abs(ridge - (20.0 + 100.0 * found.time)).max() <= 10.0  # one line
    with pytest.raises(ValueError, match="a slice of 3 s does not fit in 2 s"):
        waterfall(time, time, 3.0)


def test_an_envelope_keeps_ends_and_extremes_of_every_piece():
    values = np.random.default_rng(2).standard_normal(10_000)
    values[[1234, 7777]] = 50.0, -60.0
    kept = envelope(values, 500)
    assert kept.size <= 500
    assert (np.diff(kept) > 0).all()
    assert {0, 1234, 7777, 9999} <= set(kept)
    for piece in np.array_split(np.arange(10_000), 100):
        inside = values[kept[(kept >= piece[0] - 60) & (kept <= piece[-1] + 60)]]
        assert inside.max() >= values[piece].max()
        assert inside.min() <= values[piece].min()
    np.testing.assert_array_equal(envelope(values[:400], 500), np.arange(400))


def test_a_spectrum_over_orders_reads_every_order_of_a_run_up():
    time = np.arange(0.0, 2.0, 2e-4)
    speed, theta = 60.0 + 80.0 * time, 60.0 * time + 40.0 * time**2
    found = order_spectrum(time, signal(theta, {k / SPEED: a for k, a in TONES.items()}), speed, 40)
    for k, a in TONES.items():
        at = int(np.argmin(abs(found.frequency - k)))
        assert found.frequency[at] == pytest.approx(k, abs=1e-9)
        assert found.amplitude[at] == pytest.approx(abs(a), rel=1e-6)
    amplitudes = order_amplitudes(
        time, signal(theta, {k / SPEED: a for k, a in TONES.items()}), speed, list(TONES)
    )
    np.testing.assert_allclose(amplitudes, list(TONES.values()), rtol=1e-6)


def test_an_order_is_tracked_while_the_speed_changes():
    """A run-up: amplitude and lag of 1X at each speed to 1e-6, beside a drifting mean."""
    time = np.arange(0.0, 4.0, 5e-4)
    speed = 60.0 + 80.0 * time
    theta = 60.0 * time + 40.0 * time**2
    signal = 3.0 + 0.2 * time + (1.0 + 0.5 * time) * np.cos(theta - 0.7)
    at, found = tracked_order(time, signal, speed)
    np.testing.assert_allclose(np.abs(found), 1.0 + 0.5 * at, rtol=1e-6)
    np.testing.assert_allclose(np.angle(found), -0.7, rtol=1e-6)
    assert tracked_order(time[:50], signal[:50], speed[:50])[0].size == 0


def test_peak_to_peak_of_a_revolution_whatever_the_speed():
    """Of a motion whose speed falls and whose amplitude grows; of steady speed it is that of its samples."""
    time = np.arange(0.0, 4.0, 1e-4)
    speed = 300.0 - 70.0 * time
    angle = turned_angle(time, speed)
    found = peak_to_peak_of_turns((1.0 + 1e-3 * angle) * np.cos(angle), angle)
    inside = (angle > np.pi) & (angle < angle[-1] - np.pi)
    np.testing.assert_allclose(found[inside], 2.0 + 2e-3 * angle[inside], rtol=4e-3)
    wave = np.sin(2.0 * np.pi * np.arange(400) / 40) * np.arange(400)
    even = peak_to_peak_of_turns([wave, -wave], 2.0 * np.pi * np.arange(400) / 40)
    both = running_peak_to_peak([wave, -wave], 41)
    np.testing.assert_array_equal(even[:, 20:-20], both[:, 20:-20])
