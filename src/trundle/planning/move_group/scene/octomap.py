"""Octomaps: the tree in bytes, as octomap_msgs/Octomap carries it, and its occupied cubes.

The format is that of octomap's OcTree: `binary` trees have two bits for each of a node's eight children (00 unknown,
01 free, 10 occupied, 11 a node of its own), depth first; full trees have a float32 log-odds value and a byte of
children for each node. The first cube spans resolution · 2^16.
"""

import struct
from typing import TYPE_CHECKING

import numpy as np

from trundle.base.diagnostics import TrundleError
from trundle.planning.planning_scene import Voxels

from .shapes import pose_of

if TYPE_CHECKING:
    from trundle.ros import Message

_DEPTH = 16
_MAX_NODES = 4_000_000
_OCCUPIED = 0.0
"""Log-odds above which a leaf is occupied: a probability of one half."""


class OctomapError(TrundleError):
    """An octomap that cannot be read."""


def read_octomap(message: "Message") -> Voxels:
    """Return the occupied cubes of an octomap_msgs/OctomapWithPose in its frame, which is the model's.

    Raises:
        OctomapError: another kind of tree, or damaged bytes.
    """
    octomap = message.octomap
    if str(octomap.id) not in ("OcTree", "ColorOcTree"):
        raise OctomapError(f"an octomap of type '{octomap.id}'; OcTree is read")
    resolution = float(octomap.resolution)
    if not 1e-4 < resolution < 1e3:
        raise OctomapError(f"an octomap with a resolution of {resolution} m")
    data = np.asarray(octomap.data, dtype=np.int8).tobytes()
    read = _read_binary if octomap.binary else _read_full
    cubes = read(data, has_color=str(octomap.id) == "ColorOcTree")
    if not cubes:
        return Voxels(np.zeros((0, 3)), np.zeros(0), pose_of(message.origin))
    rows = np.array(cubes, dtype=np.float64)
    sizes = resolution * 2.0 ** (_DEPTH - rows[:, 3])
    centers = (rows[:, :3] + 0.5) * sizes[:, None] - resolution * 2.0 ** (_DEPTH - 1)
    return Voxels(centers, sizes, pose_of(message.origin))


def _read_binary(data: bytes, *, has_color: bool) -> list[tuple[int, int, int, int]]:
    """Return (x, y, z, depth) of the occupied leaves."""
    del has_color  # binary trees have none
    cubes: list[tuple[int, int, int, int]] = []
    stack = [(0, 0, 0, 0)] if data else []
    at = nodes = 0
    while stack:
        x, y, z, depth = stack.pop()
        if at + 2 > len(data) or depth >= _DEPTH or nodes > _MAX_NODES:
            raise OctomapError(f"an octomap of {len(data)} bytes ends inside a node, or is deeper than {_DEPTH} levels")
        bits = data[at] | data[at + 1] << 8
        at, nodes = at + 2, nodes + 1
        inner: list[tuple[int, int, int, int]] = []
        for child in range(8):
            kind = bits >> 2 * child & 3
            cell = (2 * x + (child & 1), 2 * y + (child >> 1 & 1), 2 * z + (child >> 2 & 1), depth + 1)
            if kind == 2:
                cubes.append(cell)
            elif kind == 3:
                inner.append(cell)
        stack.extend(reversed(inner))
    return cubes


def _read_full(data: bytes, *, has_color: bool) -> list[tuple[int, int, int, int]]:
    """Return (x, y, z, depth) of the occupied leaves."""
    size = 8 if has_color else 5
    cubes: list[tuple[int, int, int, int]] = []
    stack = [(0, 0, 0, 0)] if data else []
    at = nodes = 0
    while stack:
        x, y, z, depth = stack.pop()
        if at + size > len(data) or depth > _DEPTH or nodes > _MAX_NODES:
            raise OctomapError(f"an octomap of {len(data)} bytes ends inside a node, or is deeper than {_DEPTH} levels")
        (value,) = struct.unpack_from("<f", data, at)
        children = data[at + size - 1]
        at, nodes = at + size, nodes + 1
        if not children:
            if value > _OCCUPIED:
                cubes.append((x, y, z, depth))
            continue
        cells = [
            (2 * x + (child & 1), 2 * y + (child >> 1 & 1), 2 * z + (child >> 2 & 1), depth + 1)
            for child in range(8)
            if children >> child & 1
        ]
        stack.extend(reversed(cells))
    return cubes
