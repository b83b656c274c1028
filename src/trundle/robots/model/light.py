"""Lights of a world or link."""

from typing import Literal, TypeAlias

from msgspec import Struct

from trundle.base.diagnostics import Source
from trundle.spatial import Pose, Vector3

from .material import Rgba

LightType: TypeAlias = Literal["directional", "point", "spot"]


class Light(Struct, frozen=True, kw_only=True):
    """Light source."""

    name: str
    type: LightType
    at: Source
    world_from_light: Pose = Pose()
    """Pose in the world, or in the link frame for a light on a link."""
    direction: Vector3 = (0.0, 0.0, -1.0)
    """Unit vector in the light's frame."""
    diffuse: Rgba = (1.0, 1.0, 1.0, 1.0)
    specular: Rgba = (0.1, 0.1, 0.1, 1.0)
    intensity: float = 1.0
    range_m: float = 10.0
    """Range of point and spot lights; nothing is lit beyond it."""
    constant: float = 1.0
    linear: float = 1.0
    quadratic: float = 0.0
    """Attenuation: brightness at distance d [m] is 1 / (constant + linear d + quadratic d²)."""
    inner_angle_rad: float = 0.0
    """Full angle of a spot's fully lit cone."""
    outer_angle_rad: float = 0.0
    """Full angle of a spot's outer cone."""
    falloff: float = 0.0
    """Exponent of a spot's dimming from the inner to the outer cone; 1 is linear."""
    cast_shadows: bool = False
    added: bool = False
