"""Convex pieces of shapes: what is checked for collisions."""

from collections.abc import Sequence
from functools import lru_cache

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.base.diagnostics import UsageError
from trundle.planning._planning import (
    CollisionShape,
    box_shape,
    cylinder_shape,
    hull_shape,
    plane_shape,
    sphere_shape,
    surface_shape,
)
from trundle.robots.meshes import Mesh, MeshError, check_vertices
from trundle.robots.model import Box, Cone, Cylinder, Plane, Sphere
from trundle.sim.physics import MAX_CORNERS, convex_parts, hull_corners, moving_pieces
from trundle.spatial import Pose, rotation_from_z

from .objects import PlacedShape, ShapeGeometry

MAX_TRIANGLES = 200_000
"""Maximum number of triangles of a mesh."""
_MAX_CARRIED = 256
"""Maximum number of triangles of a mesh that moves and is checked by them."""
_CONE_SIDES = 32
_MAX_LENGTH = 1e5
"""[m]"""


class Pieces(Struct, frozen=True, eq=False):
    """Convex shapes and their poses in the frame of their owner."""

    shapes: list[CollisionShape]
    poses: NDArray[np.float64]
    """(N, 7) x y z [m], qx qy qz qw."""


def pose_row(pose: Pose) -> tuple[float, ...]:
    """Return x, y, z, qx, qy, qz, qw.

    Raises:
        UsageError: not finite, too far away, or a quaternion without length.
    """
    w, x, y, z = pose.quaternion
    row = (*pose.position, x, y, z, w)
    if not all(np.isfinite(row)) or max(map(abs, pose.position)) > _MAX_LENGTH:
        raise UsageError(f"a pose needs finite numbers within ±{_MAX_LENGTH:g} m, got {row}")
    if not w * w + x * x + y * y + z * z > 1e-12:
        raise UsageError("a pose needs a quaternion; (0, 0, 0, 0) is no rotation")
    return row


def pieces_of(shapes: Sequence[PlacedShape], owner: str, *, moves: bool) -> Pieces:
    """Return the pieces of an object's shapes.

    Primitives are themselves, but for a cone, which is a pyramid of 32 sides around it. A convex mesh is its hull. One
    that is not is checked by its triangles, exactly; if it moves and has many, by convex pieces of it.

    Args:
        shapes: shapes in the owner's frame.
        owner: name, for errors.
        moves: True if a link carries it.

    Raises:
        UsageError: numbers that are no lengths, or a mesh with too many triangles.
    """
    made: list[CollisionShape] = []
    rows: list[tuple[float, ...]] = []
    for shape in shapes:
        pose = shape.pose
        if isinstance(shape.geometry, Plane):
            pose = pose @ Pose(quaternion=rotation_from_z(shape.geometry.normal))
        pieces = _shapes_of(shape.geometry, owner, moves)
        made += pieces
        rows += [pose_row(pose)] * len(pieces)
        if sum(piece.size for piece in made) > 2 * MAX_TRIANGLES:
            raise UsageError(f"{owner!r} has more than {2 * MAX_TRIANGLES} pieces")
    return Pieces(made, np.array(rows, dtype=np.float64).reshape(-1, 7))


def _shapes_of(geometry: ShapeGeometry, owner: str, moves: bool) -> list[CollisionShape]:
    match geometry:
        case Box(size):
            return [box_shape(*_lengths(size, owner, "a box"))]
        case Sphere(radius):
            return [sphere_shape(*_lengths((radius,), owner, "a sphere"))]
        case Cylinder(radius, length):
            return [cylinder_shape(*_lengths((radius, length), owner, "a cylinder"))]
        case Cone(radius, length):
            radius, length = _lengths((radius, length), owner, "a cone")
            return [_cone(radius, length)]
        case Plane():
            return [plane_shape()]
        case Mesh():
            return _mesh_shapes(geometry, owner, moves)


def _lengths(lengths: Sequence[float], owner: str, kind: str) -> list[float]:
    for length in lengths:
        if not 0.0 <= length <= _MAX_LENGTH:
            raise UsageError(f"{owner!r}: {kind} needs lengths from 0 to {_MAX_LENGTH:g} m, got {length}")
    return list(lengths)


def _cone(radius: float, length: float) -> CollisionShape:
    turns = np.linspace(0.0, 2 * np.pi, _CONE_SIDES, endpoint=False)
    outer = radius / np.cos(np.pi / _CONE_SIDES)  # the pyramid contains the cone
    base = np.column_stack([outer * np.cos(turns), outer * np.sin(turns), np.full(_CONE_SIDES, -length / 2)])
    return hull_shape(np.vstack([base, [0.0, 0.0, length / 2]]))


def _mesh_shapes(mesh: Mesh, owner: str, moves: bool) -> list[CollisionShape]:
    try:
        check_vertices(mesh.vertices)
    except MeshError as error:
        raise UsageError(f"{owner!r}: {error}") from None
    count = len(mesh.vertices)
    if not len(mesh.faces) or mesh.faces.min() < 0 or mesh.faces.max() >= count:
        raise UsageError(f"{owner!r}: a mesh needs triangles of its {count} vertices")
    return list(_cached_mesh_shapes(_MeshKey(mesh), owner, moves))


class _MeshKey:
    """Mesh by its contents."""

    def __init__(self, mesh: Mesh) -> None:
        self.mesh = mesh
        self._key = (mesh.vertices.tobytes(), mesh.faces.tobytes())
        self._hash = hash(self._key)

    def __hash__(self) -> int:
        return self._hash

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _MeshKey) and self._key == other._key


@lru_cache(maxsize=64)
def _cached_mesh_shapes(key: _MeshKey, owner: str, moves: bool) -> tuple[CollisionShape, ...]:
    vertices, faces = key.mesh.vertices.astype(np.float64), key.mesh.faces
    if len(faces) > MAX_TRIANGLES:
        raise UsageError(
            f"{owner!r}: a mesh of {len(faces)} triangles; at most {MAX_TRIANGLES} are checked: simplify it"
        )
    parts = convex_parts(vertices, faces.astype(np.intp))
    if parts is not None:
        return tuple(hull_shape(hull_corners(corners, MAX_CORNERS)) for corners in parts)
    pieces = None
    if moves and len(faces) > _MAX_CARRIED:
        (pieces,) = moving_pieces([(vertices, faces.astype(np.intp))])
    if pieces is None:
        return (surface_shape(vertices, np.ascontiguousarray(faces, dtype=np.int32)),)
    return tuple(hull_shape(hull_corners(corners, MAX_CORNERS)) for corners in pieces)
