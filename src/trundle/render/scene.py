"""What there is to see: shapes that ride on bodies, and lights.

A scene is plain data. Renderers and the viewer both draw it; neither knows where it came from.
"""

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.meshes import Mesh, Texture
from trundle.model import Box, Capsule, Cylinder, Ellipsoid, Fog, LightType, Plane, Rgba, Sphere
from trundle.spatial import Pose, Vector3

if TYPE_CHECKING:
    from trundle.model import AnimationState

ShapeGeometry = Box | Capsule | Cylinder | Ellipsoid | Mesh | Plane | Sphere


class Shape(Struct, frozen=True, kw_only=True):
    """One thing that is seen, fixed to a body."""

    name: str
    body: int
    """Index into the poses given when the scene is drawn."""
    geometry: ShapeGeometry
    body_from_shape: Pose = Pose()
    rgba: Rgba = (0.7, 0.7, 0.7, 1.0)
    """In diffuse light; its opacity is the shape's."""
    ambient: Rgba | None = None
    """In ambient light; None: as `rgba`."""
    specular: Rgba = (0.0, 0.0, 0.0, 1.0)
    shininess: float = 16.0
    """The exponent of highlights."""
    emissive: Rgba = (0.0, 0.0, 0.0, 1.0)
    texture: Texture | None = None
    """An image over the shape, tinted by `rgba` and `ambient`; on a mesh by its `uv`."""
    texture_scale: tuple[float, float] = (1.0, 1.0)
    """As `Material.texture_scale`."""
    casts_shadow: bool = True
    laser_retro: float = 0.0
    """What a laser gets back, as its intensity."""


class SceneLight(Struct, frozen=True, kw_only=True):
    """A source of light, fixed to a body or to the world."""

    kind: LightType = "directional"
    body: int | None = None
    """Index into the poses; None: the world."""
    position: Vector3 = (0.0, 0.0, 0.0)
    direction: Vector3 = (0.0, 0.0, -1.0)
    """Unit, in the body's frame: where the light travels to."""
    diffuse: Rgba = (0.8, 0.8, 0.8, 1.0)
    specular: Rgba = (0.1, 0.1, 0.1, 1.0)
    attenuation: Vector3 = (1.0, 0.0, 0.0)
    """Constant, linear, quadratic: brightness at distance d [m] is 1 / (constant + linear d + quadratic d²)."""
    range_m: float = 1e9
    inner_angle_rad: float = 0.0
    outer_angle_rad: float = 1.0
    """Of a spot's full brightness and of its whole cone, from rim to rim."""
    falloff: float = 1.0
    casts_shadows: bool = False


class SceneSkin(Struct, frozen=True, eq=False, kw_only=True):
    """An actor's skin: meshes whose vertices move in their body's frame."""

    actor: str
    first: int
    """The number of its first shape; the others follow."""
    rows: tuple[NDArray[np.intp], ...]
    """Of each shape: which of the skin's vertices are its own."""
    vertices: "Callable[[AnimationState], NDArray[np.float32]]"
    """(N, 3) All of them at a moment, in the body's frame [m]."""


class Scene(Struct, frozen=True, kw_only=True):
    """Everything a picture can show."""

    bodies: tuple[str, ...]
    """Names; the order of the poses."""
    shapes: tuple[Shape, ...]
    skins: tuple[SceneSkin, ...] = ()
    """Shapes that change as time passes."""
    lights: tuple[SceneLight, ...] = ()
    ambient: Rgba = (0.4, 0.4, 0.4, 1.0)
    background: Rgba = (0.7, 0.7, 0.7, 1.0)
    sky: tuple[Rgba, Rgba] | None = None
    """Colours at the horizon and overhead, instead of the background."""
    fog: Fog = Fog()
