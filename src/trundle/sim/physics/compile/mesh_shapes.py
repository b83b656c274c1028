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
from ..convex.simplification import MAX_CORNERS
from ..convex.splitting import split_mesh
from .convex_geoms import add_hull, add_hulls, thick_pieces
from .kinematic_tree import KinematicTree
from .shape_entry import CollidesWith

if TYPE_CHECKING:
    from ..convex.background import BackgroundCutting


def cut_meshes(tree: KinematicTree, background: "BackgroundCutting | None") -> WorldDecomposition:
    """Decompose the meshes of collisions, in file order; unreadable ones are reported by `add_mesh`.

    Args:
        tree: links with their collisions.
        background: decomposes slow meshes meanwhile; None: all are decomposed before the return.
    """

    def requests() -> Iterator[MeshRequest]:
        for node in tree.links.values():
            for collision in node.link.collisions:
                with suppress(MeshError):
                    mesh = _mesh_of(collision)
                    if mesh is not None:
                        yield (*_arrays(mesh), node.name in tree.immobile)

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
        report.warn(collision.at, f"{error}; the collision is left out", error.id)
        return []
    if mesh is None:
        return []
    if decomposition is None:
        corners = mesh.vertices.astype(float)
        split = split_mesh(*_arrays(mesh), fixed=False) if not fixed or len(corners) > MAX_CORNERS else None
        if split is not None and len(split.corners) == 1 and not split.concave:
            (corners,) = split.corners  # a subset, for a very fine mesh
        elif split is not None and split.concave and not fixed:
            mesh_text = f"a mesh of {len(mesh.faces)} triangles that is not convex; its pieces are"
            report.info(
                collision.at,
                f"collision {collision.name!r}: {mesh_text} not checked (check --collisions)",
                "approximated-shape",
            )
        (corners,) = thick_pieces([corners], collision, report)
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
    # On a plane the pieces' common hull replaces them, with far fewer contact points.
    hull = add_hull(spec, body, pose, f"{name}#hull", np.concatenate(corners))
    return [(hull, CollidesWith.PLANES), *((geom, CollidesWith.FIXED | CollidesWith.MOVING) for geom in geoms)]


def _report_cut(cut: DecomposedMesh, mesh: Mesh, collision: Collision, report: Diagnostics) -> None:
    """Report the shape that replaces a concave or a very fine mesh, and its deviation."""
    if cut.simplified_by:
        count = sum(map(len, cut.pieces.corners))
        note = f"{count:,} corners of {len(mesh.vertices):,}, a surface up to {cut.simplified_by:.2g} m away"
        report.info(
            collision.at, f"collision {collision.name!r}: a very fine mesh; physics uses {note}", "approximated-shape"
        )
    errors = cut.pieces.errors
    if not errors or cut.is_stand_in:
        return
    worst = max(errors, key=lambda error: error.distance)
    is_filled = any(error.is_filled for error in errors)
    method = "fills its cavities" if is_filled else f"uses {len(cut.pieces.corners)} convex pieces"
    times = "" if worst.volume_ratio is None else f"{round(worst.volume_ratio, 2):g} times its volume, "
    mesh_text = f"a hollow mesh of {len(mesh.faces)} triangles; physics {method}"
    text = f"collision {collision.name!r}: {mesh_text}: {times}a surface up to {worst.distance:.2g} m away"
    if cut.is_failed:
        report.warn(collision.at, f"{text}; it could not be cut into convex pieces", "approximated-shape")
    elif cut.is_coarse:
        report.warn(collision.at, f"{text}; fewer pieces to save time; {FULL}=1 computes all", "approximated-shape")
    else:
        report.info(collision.at, text, "approximated-shape")


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
