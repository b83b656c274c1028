"""Shapes of objects, and their messages."""

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from trundle.planning.planning_scene import ShapeGeometry
from trundle.robots.meshes import Mesh
from trundle.robots.model import Box, Cone, Cylinder, Plane, Sphere
from trundle.spatial import Pose, Vector3, multiply

if TYPE_CHECKING:
    from trundle.ros import Message

_BOX, _SPHERE, _CYLINDER, _CONE = 1, 2, 3, 4
"""Types of shape_msgs/SolidPrimitive."""
_COUNTS = {_BOX: 3, _SPHERE: 1, _CYLINDER: 2, _CONE: 2}
_NAMES = {_BOX: "box", _SPHERE: "sphere", _CYLINDER: "cylinder", _CONE: "cone"}
MAX_TRIANGLES = 500_000
_SHOWN_M = 10.0
"""Length of the square that stands for a plane in pictures."""


def pose_of(message: "Message") -> Pose:
    """Read a geometry_msgs/Pose; an orientation of zeros is none.

    Raises:
        ValueError: a number is not finite.
    """
    p, q = message.position, message.orientation
    norm = math.hypot(q.w, q.x, q.y, q.z)
    if not math.isfinite(norm + p.x + p.y + p.z):
        raise ValueError("a pose has numbers that are not finite")
    position: Vector3 = (float(p.x), float(p.y), float(p.z))
    if norm < 1e-6:
        return Pose(position)
    return Pose(position, (q.w / norm, q.x / norm, q.y / norm, q.z / norm))


def pose_fields(pose: Pose) -> dict[str, Any]:
    """Return the fields of a geometry_msgs/Pose."""
    (x, y, z), (qw, qx, qy, qz) = pose.position, pose.quaternion
    return {"position": {"x": x, "y": y, "z": z}, "orientation": {"w": qw, "x": qx, "y": qy, "z": qz}}


def primitive_of(message: "Message") -> ShapeGeometry:
    """Read a shape_msgs/SolidPrimitive.

    Raises:
        ValueError: unknown type, or dimensions that are missing or not positive.
    """
    kind = int(message.type)
    count = _COUNTS.get(kind)
    if count is None:
        raise ValueError(f"a primitive of type {kind}; types: 1 (box), 2 (sphere), 3 (cylinder), 4 (cone)")
    numbers = [float(number) for number in message.dimensions][:count]
    if len(numbers) < count or not all(math.isfinite(number) and number >= 0.0 for number in numbers):
        raise ValueError(f"a {_NAMES[kind]} needs {count} dimensions ≥ 0, got {list(message.dimensions)}")
    if kind == _BOX:
        return Box((numbers[0], numbers[1], numbers[2]))
    if kind == _SPHERE:
        return Sphere(numbers[0])
    return Cylinder(numbers[1], numbers[0]) if kind == _CYLINDER else Cone(numbers[1], numbers[0])


def mesh_of(message: "Message") -> Mesh:
    """Read a shape_msgs/Mesh.

    Raises:
        ValueError: no or too many triangles, or an index without vertex.
    """
    if not 0 < len(message.triangles) <= MAX_TRIANGLES:
        raise ValueError(f"a mesh of {len(message.triangles)} triangles; 1 to {MAX_TRIANGLES} are accepted")
    vertices = np.array([[v.x, v.y, v.z] for v in message.vertices], dtype=np.float64).reshape(-1, 3)
    faces = np.array([list(t.vertex_indices) for t in message.triangles], dtype=np.int64).reshape(-1, 3)
    if not np.all(np.isfinite(vertices)) or faces.min() < 0 or faces.max() >= len(vertices):
        raise ValueError("a mesh with vertices that are not finite or do not exist")
    return Mesh(vertices.astype(np.float32), faces.astype(np.int32))


def plane_of(message: "Message") -> tuple[Plane, Pose]:
    """Read a shape_msgs/Plane as a plane through the origin of its own pose.

    Its points have ax + by + cz = d. The message's comment says ax + by + cz + d = 0, but MoveIt hands the numbers to
    FCL's Plane, whose distance is n·x − d, and draws them so.

    Raises:
        ValueError: not finite, or no normal.
    """
    a, b, c, d = (float(number) for number in message.coef)
    norm = math.sqrt(a * a + b * b + c * c)
    if not math.isfinite(norm + d) or norm == 0.0:
        raise ValueError(f"a plane needs a normal and an offset, got {[a, b, c, d]}")
    normal = (a / norm, b / norm, c / norm)
    return Plane(normal, (_SHOWN_M, _SHOWN_M)), Pose(multiply(normal, d / norm))


def shape_fields(shape: ShapeGeometry) -> tuple[str, dict[str, Any]]:
    """Return the list of a CollisionObject that a shape belongs to, and the fields of its message."""
    match shape:
        case Box(size=size):
            return "primitives", {"type": _BOX, "dimensions": list(size)}
        case Sphere(radius=radius):
            return "primitives", {"type": _SPHERE, "dimensions": [radius]}
        case Cylinder(radius=radius, length=length):
            return "primitives", {"type": _CYLINDER, "dimensions": [length, radius]}
        case Cone(radius=radius, length=length):
            return "primitives", {"type": _CONE, "dimensions": [length, radius]}
        case Plane(normal=normal):
            return "planes", {"coef": [*normal, 0.0]}
        case Mesh(vertices=vertices, faces=faces):
            return "meshes", {
                "vertices": [{"x": x, "y": y, "z": z} for x, y, z in vertices.tolist()],
                "triangles": [{"vertex_indices": face} for face in faces.tolist()],
            }
