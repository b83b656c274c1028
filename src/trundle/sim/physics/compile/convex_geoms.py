"""Convex hulls as MuJoCo geoms, from one to tens of thousands."""

from collections.abc import Sequence

import mujoco
import numpy as np
from numpy.typing import NDArray

from trundle.base.diagnostics import Diagnostics
from trundle.robots.model import Collision
from trundle.spatial import Pose

from .solver_settings import apply_settings

_Points = NDArray[np.float64]
MIN_THICKNESS = 1e-4
"""Smallest thickness of a shape [m]."""
_COARSEST = 2e-6
"""Smallest thickness relative to the distance from the mesh origin: MuJoCo stores vertices with 24 bits."""
_FEW = 64
_MANY = 4000
"""Maximum number of hulls per specification. The time to add a geom grows with their number, so large sets are built
in separate specifications and attached.
"""


def add_hull(spec: mujoco.MjSpec, body: mujoco.MjsBody, pose: Pose, name: str, corners: _Points) -> mujoco.MjsGeom:
    """Add the convex hull of corners (N, 3) [m]; MuJoCo computes it from a mesh without faces."""
    spec.add_mesh(name=name, uservert=corners.reshape(-1), inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_CONVEX)
    geom = body.add_geom(name=name, pos=pose.position, quat=pose.quaternion, group=3)
    geom.type, geom.meshname = mujoco.mjtGeom.mjGEOM_MESH, name
    return geom


def add_hulls(
    spec: mujoco.MjSpec, body: mujoco.MjsBody, pose: Pose, name: str, pieces: Sequence[_Points]
) -> list[mujoco.MjsGeom]:
    """Add the hulls of pieces, named `name#0`, `name#1`, …"""
    if len(pieces) <= _FEW:
        return [add_hull(spec, body, pose, f"{name}#{i}", corners) for i, corners in enumerate(pieces)]
    geoms: list[mujoco.MjsGeom] = []
    for first in range(0, len(pieces), _MANY):
        part_spec = mujoco.MjSpec()
        apply_settings(part_spec)
        frame = part_spec.worldbody.add_frame()
        part_spec.default.name = f"{first}"  # defaults are attached, too; two of one name would make invalid MJCF
        for i, corners in enumerate(pieces[first : first + _MANY], start=first):
            geoms.append(add_hull(part_spec, part_spec.worldbody, pose, f"{i}", corners))
            geoms[-1].set_frame(frame)
        body.attach_frame(frame, f"{name}#", "")
    return geoms


def thicken(pieces: Sequence[_Points]) -> tuple[list[_Points], float]:
    """Return pieces (N, 3) [m] with flat ones and lines extruded to a minimum thickness, and the largest thickness
    added [m], 0 if none.
    """
    thick = list(pieces)
    thickest = 0.0
    by_size: dict[int, list[int]] = {}
    for i, corners in enumerate(pieces):
        by_size.setdefault(len(corners), []).append(i)
    for numbers in by_size.values():
        corners = np.stack([pieces[i] for i in numbers])
        thinnest = np.maximum(MIN_THICKNESS, _COARSEST * np.abs(corners).max(axis=(1, 2)))
        centred = corners - corners.mean(axis=1, keepdims=True)
        axes = np.linalg.eigh(centred.transpose(0, 2, 1) @ centred)[1]
        is_thin = np.ptp(centred @ axes, axis=1) < thinnest[:, None]
        for row in np.flatnonzero(is_thin.any(axis=1)).tolist():
            for axis in axes[row].T[is_thin[row]]:
                layer, half = thick[numbers[row]], axis * thinnest[row] / 2
                thick[numbers[row]] = np.concatenate([layer - half, layer + half])
            thickest = max(thickest, float(thinnest[row]))
    return thick, thickest


def thick_pieces(pieces: Sequence[_Points], collision: Collision, report: Diagnostics) -> list[_Points]:
    """Return pieces (N, 3) [m] thick enough for a hull, with a warning about flat ones."""
    thick, thickest = thicken(pieces)
    if thickest:
        problem = f"a mesh of zero thickness; physics uses {thickest * 1000:.2g} mm"
        report.warn(collision.at, f"collision {collision.name!r}: {problem}", "degenerate-shape")
    return thick
