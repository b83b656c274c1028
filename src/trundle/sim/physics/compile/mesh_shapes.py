"""Mesh collisions as MuJoCo geoms: a convex hull, or convex pieces."""

from collections.abc import Iterator
from contextlib import suppress
from typing import TYPE_CHECKING

import mujoco
import numpy as np
from numpy.typing import NDArray

from trundle.base.diagnostics import Diagnostics
from trundle.robots.meshes import Mesh, MeshError, check_vertices, load_mesh
from trundle.robots.model import Collision, MeshFile

from ..convex.hulls import hull_of
from ..convex.mesh_decomposition import FULL, DecomposedMesh, MeshRequest, WorldDecomposition
from ..convex.pieces import split_mesh
from .convex_geoms import add_hull, add_hulls, thick_pieces
from .kinematic_tree import KinematicTree
from .shape_entry import CollidesWith

if TYPE_CHECKING:
    from ..convex.background import BackgroundCutting


def cut_meshes(tree: KinematicTree, background: "BackgroundCutting | None") -> WorldDecomposition:
    """Decompose the meshes of collisions, in file order; unreadable ones are reported by `add_mesh`.

    Args:
        tree: links with their collisions.
        background: cuts what takes long; None: it is waited for.
    """

    def requests() -> Iterator[MeshRequest]:
        for place in tree.links.values():
            for collision in place.link.collisions:
                with suppress(MeshError):
                    mesh = _mesh_of(collision)
                    if mesh is not None:
                        yield (*_arrays(mesh), place.name in tree.immobile)

    decomposition = WorldDecomposition(background)
    decomposition.decompose_all(requests())
    return decomposition


def add_mesh(
    spec: mujoco.MjSpec,
    body: mujoco.MjsBody,
    collision: Collision,
    name: str,
    report: Diagnostics,
    *,
    fixed: bool,
    decomposition: WorldDecomposition | None,
) -> list[tuple[mujoco.MjsGeom, CollidesWith]]:
    """Add a mesh collision to a body; arguments as in `add_shape`."""
    try:
        mesh = _mesh_of(collision)
    except MeshError as error:
        report.warn(collision.at, f"{error}; the collision is left out")
        return []
    if mesh is None:
        return []
    if decomposition is None:
        if not fixed and split_mesh(*_arrays(mesh), fixed=False).concave:
            what = f"a mesh of {len(mesh.faces)} triangles that is not convex; its pieces are"
            report.info(collision.at, f"collision {collision.name!r}: {what} not checked (check --collisions)")
        (corners,) = thick_pieces([mesh.vertices.astype(float)], collision, report)
        return [(add_hull(spec, body, collision.link_from_collision, name, corners), CollidesWith.ALL)]
    cut = decomposition.pieces_of(*_arrays(mesh), fixed=fixed)
    _report_cut(cut, mesh, collision, report)
    return _add_pieces(spec, body, collision, name, report, cut.pieces.corners, fixed=fixed)


def _add_pieces(
    spec: mujoco.MjSpec,
    body: mujoco.MjsBody,
    collision: Collision,
    name: str,
    report: Diagnostics,
    pieces: list[NDArray[np.float64]],
    *,
    fixed: bool,
) -> list[tuple[mujoco.MjsGeom, CollidesWith]]:
    pose = collision.link_from_collision
    corners = thick_pieces(pieces, collision, report)
    if len(corners) == 1:
        return [(add_hull(spec, body, pose, name, corners[0]), CollidesWith.ALL)]
    geoms = add_hulls(spec, body, pose, name, corners)
    if fixed or hull_of(np.concatenate(corners)) is None:
        return [(geom, CollidesWith.ALL) for geom in geoms]
    # On a plane the pieces stand as their common hull, which has far fewer contact points.
    hull = add_hull(spec, body, pose, f"{name}#hull", np.concatenate(corners))
    return [(hull, CollidesWith.PLANES), *((geom, CollidesWith.STANDING | CollidesWith.MOVING) for geom in geoms)]


def _report_cut(cut: DecomposedMesh, mesh: Mesh, collision: Collision, report: Diagnostics) -> None:
    """Report what a concave mesh is simulated as, and its deviation."""
    misfits = cut.pieces.errors
    if not misfits or cut.is_stand_in:
        return
    worst = max(misfits, key=lambda misfit: misfit.distance)
    is_filled = any(misfit.is_filled for misfit in misfits)
    how = "fills its cavities" if is_filled else f"uses {len(cut.pieces.corners)} convex pieces"
    times = "" if worst.volume_ratio is None else f"{round(worst.volume_ratio, 2):g} times its volume, "
    what = f"a hollow mesh of {len(mesh.faces)} triangles; physics {how}"
    said = f"collision {collision.name!r}: {what}: {times}a surface up to {worst.distance:.2g} m away"
    if cut.is_failed:
        report.warn(collision.at, f"{said}; it could not be cut into convex pieces")
    elif cut.is_coarse:
        report.warn(collision.at, f"{said}; fewer pieces to save time; {FULL}=1 computes all")
    else:
        report.info(collision.at, said)


def _arrays(mesh: Mesh) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
    """Return vertices (N, 3) [m] and faces (M, 3) of a mesh."""
    return mesh.vertices.astype(float), mesh.faces.astype(np.intp)


def _mesh_of(collision: Collision) -> Mesh | None:
    """Read the scaled mesh of a collision; None for other shapes.

    Raises:
        MeshError: it cannot be read.
    """
    geometry = collision.geometry
    if not isinstance(geometry, MeshFile) or geometry.path is None:
        return None
    mesh = load_mesh(geometry.path, submesh=geometry.submesh, center=geometry.center_submesh)
    scaled = mesh.scaled(geometry.scale)
    check_vertices(scaled.vertices)
    return scaled
