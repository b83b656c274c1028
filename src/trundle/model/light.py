"""What lights the models."""

from typing import Literal, TypeAlias

from msgspec import Struct

from trundle.diagnostics import Source
from trundle.spatial import Pose, Vector3

from .material import Rgba

LightType: TypeAlias = Literal["directional", "point", "spot"]


class Light(Struct, frozen=True, kw_only=True):
    """A source of light."""

    name: str
    type: LightType
    at: Source
    world_from_light: Pose = Pose()
    """Of a light on a link: in the link's frame."""
    direction: Vector3 = (0.0, 0.0, -1.0)
    """Unit, in the light's frame."""
    diffuse: Rgba = (1.0, 1.0, 1.0, 1.0)
    specular: Rgba = (0.1, 0.1, 0.1, 1.0)
    intensity: float = 1.0
    range_m: float = 10.0
    """Beyond it nothing is lit, by point and spot lights."""
    constant: float = 1.0
    linear: float = 1.0
    quadratic: float = 0.0
    """Brightness at distance d [m] is 1 / (constant + linear d + quadratic d²)."""
    inner_angle_rad: float = 0.0
    """Of a spot's full brightness, from rim to rim."""
    outer_angle_rad: float = 0.0
    """Of a spot's whole cone."""
    falloff: float = 0.0
    """How a spot dims from the inner to the outer cone; 1 is linear."""
    cast_shadows: bool = False
    added: bool = False
