"""Scene data: shapes fixed to bodies, and lights.

A scene is plain data for renderers and the page, independent of its source.
"""

from typing import TYPE_CHECKING, Protocol

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.robots.meshes import Mesh, Texture
from trundle.robots.model import Box, Capsule, Cylinder, Ellipsoid, Fog, LightType, Plane, Rgba, Sphere
from trundle.spatial import Pose, Vector3

if TYPE_CHECKING:
    from trundle.robots.meshes import Skin
    from trundle.robots.model import AnimationState

ShapeGeometry = Box | Capsule | Cylinder | Ellipsoid | Mesh | Plane | Sphere


class Shape(Struct, frozen=True, kw_only=True):
    """Visible shape fixed to a body."""

    name: str
    body: int
    """Index into the poses."""
    geometry: ShapeGeometry
    body_from_shape: Pose = Pose()
    rgba: Rgba = (0.7, 0.7, 0.7, 1.0)
    """Diffuse color and opacity."""
    ambient: Rgba | None = None
    """Ambient color; None: `rgba`."""
    specular: Rgba = (0.0, 0.0, 0.0, 1.0)
    shininess: float = 16.0
    """Phong exponent."""
    emissive: Rgba = (0.0, 0.0, 0.0, 1.0)
    texture: Texture | None = None
    """Texture tinted by `rgba` and `ambient`; mapped by `uv` on a mesh."""
    texture_scale: tuple[float, float] = (1.0, 1.0)
    """Same as `Material.texture_scale`."""
    casts_shadow: bool = True
    laser_retro: float = 0.0
    """Intensity of a laser's return."""


class SceneLight(Struct, frozen=True, kw_only=True):
    """Light fixed to a body or to the world."""

    name: str = ""
    kind: LightType = "directional"
    body: int | None = None
    """Index into the poses; None: the world."""
    position: Vector3 = (0.0, 0.0, 0.0)
    direction: Vector3 = (0.0, 0.0, -1.0)
    """Unit direction of the light rays, in the body's frame."""
    diffuse: Rgba = (0.8, 0.8, 0.8, 1.0)
    specular: Rgba = (0.1, 0.1, 0.1, 1.0)
    attenuation: Vector3 = (1.0, 0.0, 0.0)
    """Constant, linear, quadratic: brightness at distance d [m] is 1 / (constant + linear d + quadratic d²)."""
    range_m: float = 1e9
    inner_angle_rad: float = 0.0
    outer_angle_rad: float = 1.0
    """Full angles of a spot's cones: `inner_angle_rad` of the fully lit one, `outer_angle_rad` of the outer one."""
    falloff: float = 1.0
    casts_shadows: bool = False


DEFAULT_LIGHTS = (SceneLight(direction=(-0.3, 0.5, -0.8)),)
"""Lights of a scene without any."""


class AnimatedSkin(Protocol):
    """Skin with the bones that deform it."""

    @property
    def skin(self) -> "Skin":
        """Skin in the bind pose."""
        ...

    @property
    def bones(self) -> tuple[str, ...]:
        """Names of the bones."""
        ...

    @property
    def bone_from_skin(self) -> NDArray[np.float64]:
        """Bind matrices (B, 4, 4) of the bones."""
        ...

    def bone_poses(self, state: "AnimationState") -> NDArray[np.float64]:
        """Return (B, 7) x y z [m], qw qx qy qz of the bones in the body's frame."""
        ...

    def vertices(self, state: "AnimationState") -> NDArray[np.float32]:
        """Return (N, 3) vertices in the body's frame [m]."""
        ...


class SceneSkin(Struct, frozen=True, eq=False, kw_only=True):
    """Skin of an actor: meshes that its bones deform."""

    actor: str
    body: int
    """Index of the body that is the frame of its animation."""
    first: int
    """Index of its first shape; the others follow."""
    rows: tuple[NDArray[np.intp], ...]
    """Indices of each shape's vertices in the skin's."""
    animated: AnimatedSkin


class Scene(Struct, frozen=True, kw_only=True):
    """Contents of an image: shapes, lights and background."""

    bodies: tuple[str, ...]
    """Body names in the order of the poses."""
    shapes: tuple[Shape, ...]
    skins: tuple[SceneSkin, ...] = ()
    """Animated shapes."""
    lights: tuple[SceneLight, ...] = ()
    ambient: Rgba = (0.4, 0.4, 0.4, 1.0)
    background: Rgba = (0.7, 0.7, 0.7, 1.0)
    sky: tuple[Rgba, Rgba] | None = None
    """Colors at the horizon and overhead, which replace the background."""
    fog: Fog = Fog()

    @property
    def bones(self) -> tuple[str, ...]:
        """Names of all skins' bones, `actor::bone 0`."""
        return tuple(f"{skin.actor}::{bone}" for skin in self.skins for bone in skin.animated.bones)
