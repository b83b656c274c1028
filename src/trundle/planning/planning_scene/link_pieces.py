"""Collision shapes of a robot's links as convex pieces."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.base.diagnostics import Diagnostics, TrundleError
from trundle.planning._planning import (
    CollisionShape,
    box_shape,
    cylinder_shape,
    hull_shape,
    sphere_shape,
    surface_shape,
)
from trundle.robots.meshes import Mesh, load_mesh
from trundle.robots.packages import Packages
from trundle.robots.robot import RobotBox, RobotCylinder, RobotLink, RobotMesh, RobotShape, RobotSphere
from trundle.sim.physics import MAX_CORNERS, hull_corners, moving_pieces

from .pieces import Pieces, pose_row


class LinkShape(Struct, frozen=True, eq=False):
    """<collision> of a link: a primitive, or the convex pieces or the triangles of its mesh."""

    geometry: RobotBox | RobotCylinder | RobotSphere | RobotMesh
    pose: tuple[float, ...]
    """x y z [m], qx qy qz qw in the link's frame."""
    corners: tuple[NDArray[np.float64], ...] = ()
    """(N, 3) corners of each piece of a mesh [m]."""
    surface: tuple[NDArray[np.float64], NDArray[np.int32]] | None = None
    """(N, 3) vertices [m] and (M, 3) faces of a mesh that is checked by its triangles."""
    middle: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """Mean of a mesh's vertices, about which it is scaled [m]."""

    def pieces(self, scale: float) -> list[CollisionShape]:
        """Return the shapes, scaled as MoveIt does: about the center of a primitive, about a mesh's mean vertex."""
        match self.geometry:
            case RobotBox(size):
                return [box_shape(*(scale * length for length in size))]
            case RobotCylinder(radius, length):
                return [cylinder_shape(scale * radius, scale * length)]
            case RobotSphere(radius):
                return [sphere_shape(scale * radius)]
            case RobotMesh():
                middle = np.array(self.middle)
                if self.surface is not None:
                    vertices, faces = self.surface
                    return [surface_shape(middle + scale * (vertices - middle), faces)]
                return [hull_shape(middle + scale * (corners - middle)) for corners in self.corners]


class LinkGeometry:
    """Collision shapes of all links; scenes share them."""

    def __init__(self, links: Mapping[str, list[LinkShape]]) -> None:
        self._links = dict(links)
        self._pieces: dict[tuple[str, float], Pieces] = {}

    def __contains__(self, link: str) -> bool:
        return bool(self._links.get(link))

    def pieces(self, link: str, scale: float) -> Pieces:
        """Return the pieces of a link's shapes at a scale."""
        key = (link, scale)
        if key not in self._pieces:
            shapes: list[CollisionShape] = []
            rows: list[tuple[float, ...]] = []
            for shape in self._links.get(link, []):
                made = shape.pieces(scale)
                shapes += made
                rows += [shape.pose] * len(made)
            self._pieces[key] = Pieces(shapes, np.array(rows, dtype=np.float64).reshape(-1, 7))
        return self._pieces[key]


def link_geometry(links: tuple[RobotLink, ...], packages: Packages | None, report: Diagnostics) -> LinkGeometry:
    """Read the collision shapes of links.

    A mesh that is not convex is cut into convex pieces, as the simulation does; one whose pieces fill what is open is
    its triangles. A mesh that cannot be read is reported and left out, as MoveIt does.

    Args:
        links: links of the URDF.
        packages: finds the meshes' files; None: only absolute paths and those beside the URDF are found.
        report: receives what is left out.
    """
    shapes = [shape for link in links for shape in link.collisions if isinstance(shape.geometry, RobotMesh)]
    meshes = [(shape, mesh) for shape in shapes if (mesh := _read(shape, packages, report)) is not None]
    cut = moving_pieces((mesh.vertices.astype(np.float64), mesh.faces.astype(np.intp)) for _, mesh in meshes)
    pieces_of = {id(shape): (pieces, mesh) for (shape, mesh), pieces in zip(meshes, cut, strict=True)}
    made: dict[str, list[LinkShape]] = {}
    for link in links:
        for shape in link.collisions:
            row = pose_row(shape.link_from_shape)
            if not isinstance(shape.geometry, RobotMesh):
                made.setdefault(link.name, []).append(LinkShape(shape.geometry, row))
            elif id(shape) in pieces_of:
                made.setdefault(link.name, []).append(_mesh_shape(shape.geometry, row, *pieces_of[id(shape)]))
    return LinkGeometry(made)


def _mesh_shape(
    geometry: RobotMesh, pose: tuple[float, ...], pieces: list[NDArray[np.float64]] | None, mesh: Mesh
) -> LinkShape:
    vertices = mesh.vertices.astype(np.float64)
    x, y, z = vertices.mean(axis=0).tolist()
    if pieces is None:
        faces = np.ascontiguousarray(mesh.faces, dtype=np.int32)
        return LinkShape(geometry, pose, surface=(vertices, faces), middle=(x, y, z))
    corners = tuple(hull_corners(piece, MAX_CORNERS) for piece in pieces)
    return LinkShape(geometry, pose, corners, middle=(x, y, z))


def _read(shape: RobotShape, packages: Packages | None, report: Diagnostics) -> Mesh | None:
    assert isinstance(shape.geometry, RobotMesh)
    uri, folder = shape.geometry.uri, Path(shape.at.file).parent
    try:
        path = folder / uri.removeprefix("file://")
        if packages is not None:
            path = packages.resolve(uri, folder=folder, at=shape.at)
        return load_mesh(path).scaled(shape.geometry.scale)
    except TrundleError as error:
        report.warn_error(error, shape.at, "nothing collides with this shape", "mesh")
        return None
