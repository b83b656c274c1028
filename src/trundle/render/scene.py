"""What there is to see: shapes that ride on bodies, and lights.

A scene is plain data. Renderers and the viewer both draw it; neither knows where it came from.
"""

from dataclasses import dataclass

from trundle.meshes import Mesh
from trundle.model import Box, Capsule, Cylinder, Ellipsoid, Plane, Rgba, Sphere
from trundle.spatial import Pose, Vector3

ShapeGeometry = Box | Capsule | Cylinder | Ellipsoid | Mesh | Plane | Sphere


@dataclass(frozen=True, slots=True, kw_only=True)
class Shape:
    """One thing that is seen, fixed to a body."""

    name: str
    body: int
    """Index into the poses given when the scene is drawn."""
    geometry: ShapeGeometry
    body_from_shape: Pose = Pose()
    rgba: Rgba = (0.7, 0.7, 0.7, 1.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class SceneLight:
    """A directional light."""

    direction: Vector3
    """Unit, in the world: where the light travels to."""
    diffuse: Rgba = (0.8, 0.8, 0.8, 1.0)


@dataclass(frozen=True, slots=True, kw_only=True)
class Scene:
    """Everything a picture can show."""

    bodies: tuple[str, ...]
    """Names; the order of the poses."""
    shapes: tuple[Shape, ...]
    lights: tuple[SceneLight, ...] = ()
    ambient: Rgba = (0.4, 0.4, 0.4, 1.0)
    background: Rgba = (0.7, 0.7, 0.7, 1.0)
