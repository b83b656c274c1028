"""Noise against its statistics."""

import math

import numpy as np
import pytest

from trundle.robots.model import Noise
from trundle.sim.sensors import NoiseSource

_STEP_NS = 10_000_000


def source(noise: Noise, seed: int = 1) -> NoiseSource:
    return NoiseSource(noise, np.random.default_rng(seed))


def test_a_bias_is_drawn_once_and_of_either_sign() -> None:
    """Half of many sources err to one side, half to the other, each by the same at every reading."""
    drawn = [source(Noise(bias_mean=5.0, bias_stddev=0.1), seed) for seed in range(200)]
    first, later = ([noise.apply_to_value(0.0, time_ns) for noise in drawn] for time_ns in (0, _STEP_NS))

    assert first == later
    assert np.abs(first).mean() == pytest.approx(5.0, abs=0.05)
    assert np.abs(first).std() == pytest.approx(0.1, abs=0.02)
    assert np.mean(np.array(first) > 0.0) == pytest.approx(0.5, abs=0.15)


def test_values_are_rounded_to_the_precision() -> None:
    noisy = source(Noise(stddev=1.0, precision=0.25)).apply(np.zeros(1000), 0)

    assert np.all(noisy % 0.25 == 0.0)
    assert len(np.unique(noisy)) > 10
    assert noisy.std() == pytest.approx(math.hypot(1.0, 0.25 / math.sqrt(12.0)), abs=0.1)


@pytest.mark.parametrize("step_ns", [_STEP_NS, 7 * _STEP_NS])
def test_a_wandering_bias_has_its_correlation_time_at_any_rate(step_ns: int) -> None:
    """Ornstein and Uhlenbeck's: its variance is density² τ / 2, and after a time t, e^(−t/τ) of it is left."""
    density, tau = 2.0, 0.5
    wandering = source(Noise(wander_density=density, wander_time_s=tau))
    values = np.array([wandering.apply_to_value(0.0, i * step_ns) for i in range(20_000)])

    assert values.std() == pytest.approx(density * math.sqrt(tau / 2.0), rel=0.1)
    left = np.corrcoef(values[:-1], values[1:])[0, 1]
    assert left == pytest.approx(math.exp(-step_ns / 1e9 / tau), abs=0.02)


def test_a_reset_of_time_keeps_the_bias() -> None:
    wandering = source(Noise(bias_mean=3.0, wander_density=1.0, wander_time_s=1.0))
    before = [wandering.apply_to_value(0.0, t) for t in (0, _STEP_NS)][-1]

    assert wandering.apply_to_value(0.0, 0) == before
