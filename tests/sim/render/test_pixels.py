"""Operations on each pixel of a picture."""

import os
import subprocess
import sys

import numpy as np
import pytest

from trundle.sim.render import add_color_noise, add_depth_noise, clip_depths, colored_points

_SEED = 0x1234_5678_9ABC_DEF0


def _normal(count: int, seed: int = _SEED) -> np.ndarray:
    depths = np.zeros((1, count), dtype=np.float32)
    add_depth_noise(depths, seed=seed, mean=0.0, stddev=1.0)
    return depths[0].astype(np.float64)


def test_noise_is_gaussian() -> None:
    """A million draws: moments within five standard errors, and the shares beyond 1, 2 and 3 sigma."""
    numbers = _normal(1_000_000)

    assert abs(numbers.mean()) < 5e-3
    assert abs(numbers.std() - 1.0) < 4e-3
    assert abs((numbers**3).mean()) < 0.02
    assert abs((numbers**4).mean() - 3.0) < 0.05
    for sigma, share in ((1.0, 0.3173), (2.0, 0.0455), (3.0, 0.0027)):
        assert np.mean(np.abs(numbers) > sigma) == pytest.approx(share, abs=5 * np.sqrt(share / 1e6))


@pytest.mark.parametrize("lag", [1, 4, 8, 16, 32, 640])
def test_noise_of_neighbouring_pixels_is_uncorrelated(lag: int) -> None:
    numbers = _normal(500_000)

    assert abs(np.corrcoef(numbers[:-lag], numbers[lag:])[0, 1]) < 7e-3


@pytest.mark.parametrize("other", [_SEED + 1, _SEED + (1 << 32), 0])
def test_another_seed_gives_different_noise(other: int) -> None:
    assert abs(np.corrcoef(_normal(200_000), _normal(200_000, other))[0, 1]) < 0.012


@pytest.mark.parametrize("count", [1, 15, 16, 31, 33, 100])
def test_a_smaller_image_has_the_first_noise_values(count: int) -> None:
    assert _normal(count).tolist() == _normal(1000)[:count].tolist()


def test_every_instruction_set_computes_the_same_noise_and_points() -> None:
    program = (
        "import numpy as np, sys; from trundle.sim.render import add_depth_noise, clip_depths, colored_points;"
        "d = np.ones((37, 41), np.float32); add_depth_noise(d, seed=99, mean=0.1, stddev=0.3);"
        "c = np.arange(37 * 41 * 3).astype(np.uint8).reshape(37, 41, 3);"
        "p = colored_points(clip_depths(d, near_m=0.9, far_m=1.3), c, d, d);"
        "sys.stdout.write(d.tobytes().hex() + p.tobytes().hex())"
    )
    outputs = {
        subprocess.run(
            [sys.executable, "-c", program],
            env={**os.environ, "TRUNDLE_RENDER_ISA": name},
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for name in ("baseline", "avx2", "avx512")
    }

    assert len(outputs) == 1


def test_depths_that_are_not_finite_stay_so() -> None:
    depths = np.array([[np.nan, np.inf, 1.0]], dtype=np.float32)

    add_depth_noise(depths, seed=1, mean=0.5, stddev=0.0)

    assert np.isnan(depths[0, 0])
    assert np.isinf(depths[0, 1])
    assert depths[0, 2] == 1.5


@pytest.mark.parametrize("in_place", [False, True])
def test_depths_outside_the_range_become_nan(in_place: bool) -> None:
    """The ends of the range are inside, infinity never is."""
    depths = np.array([[0.5, 1.0, 2.0, 3.0, 3.5], [np.nan, np.inf, -np.inf, -0.0, 1e30]], dtype=np.float32)
    out = depths if in_place else None
    expected = np.where((depths >= 1.0) & (depths <= 3.0), depths, np.float32(np.nan))
    finite = np.where(np.isfinite(depths), depths, np.float32(np.nan))

    assert clip_depths(depths).tobytes() == finite.tobytes()
    clipped = clip_depths(depths, near_m=1.0, far_m=3.0, out=out)

    assert clipped.tobytes() == expected.tobytes()
    assert (clipped is depths) == in_place


def test_color_noise_is_equal_on_all_channels_and_clipped() -> None:
    rgb = np.zeros((200, 200, 3), dtype=np.uint8)
    rgb[:] = (0, 128, 255)

    add_color_noise(rgb, seed=7, mean=0.0, stddev=0.08)

    dark, middle, bright = (rgb[..., i].astype(int) for i in range(3))
    assert np.abs(dark - np.maximum(middle - 128, 0)).max() <= 1
    assert np.abs(bright - np.minimum(middle + 127, 255)).max() <= 1
    assert middle.std() == pytest.approx(20.4, rel=0.03)


@pytest.mark.parametrize("shape", [(5, 7), (1, 16), (3, 11), (2, 40)])
def test_points_lie_on_their_pixels_rays_at_their_depths(shape: tuple[int, int]) -> None:
    """Widths of whole vectors, and a few pixels more."""
    random = np.random.default_rng(3)
    depth, right, down = (random.random(shape, dtype=np.float32) for _ in range(3))
    depth[0, 0] = np.nan
    rgb = random.integers(0, 256, (*shape, 3), dtype=np.uint8)

    points = colored_points(depth, rgb, right, down)

    assert np.array_equal(points[..., :3], np.stack([right * depth, down * depth, depth], axis=-1), equal_nan=True)
    colors = points.view("<u4")[..., 3]
    assert np.array_equal(colors, rgb[..., 0].astype(int) << 16 | rgb[..., 1].astype(int) << 8 | rgb[..., 2])


def test_arrays_of_other_sizes_are_refused() -> None:
    flat = np.zeros((2, 2), dtype=np.float32)

    with pytest.raises(ValueError, match="one height and width"):
        colored_points(flat, np.zeros((2, 3, 3), dtype=np.uint8), flat, flat)
