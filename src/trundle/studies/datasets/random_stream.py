"""Random streams of a picture, one for each part, so that a change of one part does not affect the others."""

import colorsys

import numpy as np

from trundle.spatial import Quaternion, Vector3, quaternion_from_rpy

from .plan import Color, Numbers

POSES, LOOKS, LIGHTS, CAMERA, NOISE = range(5)


def random_stream(seed: int, number: int, part: int) -> np.random.Generator:
    """Return the stream of a part of a picture."""
    return np.random.default_rng((seed, number, part))


def draw_numbers(numbers: Numbers, random: np.random.Generator) -> Vector3:
    """Draw three numbers."""
    x, y, z = (quantity.draw(random) for quantity in numbers)
    return x, y, z


def draw_color(color: Color, random: np.random.Generator) -> Vector3:
    """Draw red, green and blue, each 0 to 1."""
    if color.choices:
        return color.choices[int(random.integers(len(color.choices)))]
    hue, saturation, value = draw_numbers(color.hsv, random)
    return colorsys.hsv_to_rgb(hue % 1.0, min(max(saturation, 0.0), 1.0), min(max(value, 0.0), 1.0))


def draw_rotation(rotation: "str | Numbers", random: np.random.Generator) -> Quaternion:
    """Draw a rotation: about z only, uniform over all rotations, or from roll, pitch and yaw [rad]."""
    if rotation == "upright":
        return quaternion_from_rpy(0.0, 0.0, float(random.uniform(-np.pi, np.pi)))
    if rotation == "any":
        w, x, y, z = random.normal(size=4).tolist()
        length = float(np.linalg.norm((w, x, y, z)))
        return (w / length, x / length, y / length, z / length)
    assert not isinstance(rotation, str)
    return quaternion_from_rpy(*draw_numbers(rotation, random))
