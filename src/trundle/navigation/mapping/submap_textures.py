"""Submaps of Cartographer as pictures: packed into messages, and painted onto an occupancy grid.

A pixel has an intensity, of what is free, and an alpha, of what is occupied; neither where nothing was seen. The
columns of a picture go along −y from its corner, the rows along −x.
"""

import math
import zlib
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from trundle.spatial import Pose

from ..pose_messages import PlanarPose, planar, pose_fields, read_pose

_FREE_INTENSITY, _OCCUPIED_ALPHA = 127, 255
_BACKGROUND = 128.0
_MAX_PIXELS = 100_000_000
_EPSILON = 1e-6
"""Of corners that are in a cell only by rounding [cells]."""
_GZIP = 31
"""Window of zlib for gzip's format."""


class Texture(NamedTuple):
    """A submap's picture."""

    intensity: NDArray[np.uint8]
    """(height, width)"""
    alpha: NDArray[np.uint8]
    resolution_m: float
    submap_from_slice: Pose
    """Pose of the picture's corner, at pixel (0, 0)."""


def pack_texture(message: dict[str, Any]) -> dict[str, Any]:
    """Return the fields of a cartographer_ros_msgs/SubmapTexture of an occupancy grid whose axes are the submap's."""
    info = message["info"]
    width, height, resolution = info["width"], info["height"], info["resolution"]
    corner = info["origin"]["position"]
    cells = message["data"].reshape(height, width)[::-1, ::-1].T
    pixels = np.zeros((width, height, 2), dtype=np.uint8)
    pixels[cells == 0, 0] = _FREE_INTENSITY
    pixels[cells == 100, 1] = _OCCUPIED_ALPHA
    packer = zlib.compressobj(1, zlib.DEFLATED, _GZIP)
    place = Pose((corner["x"] + width * resolution, corner["y"] + height * resolution, 0.0))
    return {
        "cells": packer.compress(pixels.tobytes()) + packer.flush(),
        "width": height,
        "height": width,
        "resolution": resolution,
        "slice_pose": pose_fields(place),
    }


def unpack_texture(message: Any) -> Texture:
    """Read a cartographer_ros_msgs/SubmapTexture.

    Raises:
        ValueError: it is too large, its size does not fit its pixels, or a number is not finite.
    """
    width, height, resolution = int(message.width), int(message.height), float(message.resolution)
    if width < 1 or height < 1 or width * height > _MAX_PIXELS or not 0.0 < resolution < math.inf:
        raise ValueError(f"a picture of {width} × {height} pixels of {resolution:g} m")
    unpacker = zlib.decompressobj(_GZIP)
    try:
        content = unpacker.decompress(bytes(message.cells), 2 * width * height + 1)
    except zlib.error as error:
        raise ValueError(f"a picture that is not packed by gzip: {error}") from None
    if len(content) != 2 * width * height:
        raise ValueError(f"a picture of {width} × {height} pixels with {len(content)} bytes")
    pixels = np.frombuffer(content, dtype=np.uint8).reshape(height, width, 2)
    return Texture(pixels[:, :, 0], pixels[:, :, 1], resolution, read_pose(message.slice_pose))


def paint(textures: Sequence[tuple[Pose, Texture]], resolution_m: float) -> dict[str, Any] | None:
    """Return data and info of a nav_msgs/OccupancyGrid of submaps at their poses, later ones above.

    None: there is none, or they are too far from each other.
    """
    places = [(planar(pose @ texture.submap_from_slice), texture) for pose, texture in textures]
    if not places:
        return None
    corners = np.concatenate([_corners(place, texture) for place, texture in places]) / resolution_m
    first, last = np.floor(corners.min(axis=0) + _EPSILON), np.ceil(corners.max(axis=0) - _EPSILON)
    width, height = (last - first).tolist()
    if not width * height <= _MAX_PIXELS:
        return None
    color = np.full((int(height), int(width)), _BACKGROUND)
    is_seen = np.zeros(color.shape, dtype=bool)
    x = (first[0] + 0.5 + np.arange(int(width))) * resolution_m
    y = (first[1] + 0.5 + np.arange(int(height))) * resolution_m
    for (px, py, yaw), texture in places:
        dx, dy = x[None, :] - px, y[:, None] - py
        column = np.floor((math.sin(yaw) * dx - math.cos(yaw) * dy) / texture.resolution_m).astype(np.int64)
        row = np.floor((-math.cos(yaw) * dx - math.sin(yaw) * dy) / texture.resolution_m).astype(np.int64)
        is_inside = (column >= 0) & (row >= 0) & (column < texture.alpha.shape[1]) & (row < texture.alpha.shape[0])
        intensity = texture.intensity[row[is_inside], column[is_inside]].astype(np.float64)
        alpha = texture.alpha[row[is_inside], column[is_inside]].astype(np.float64)
        color[is_inside] = np.minimum(intensity + (1.0 - alpha / 255.0) * color[is_inside], 255.0)
        is_seen[is_inside] |= (intensity > 0.0) | (alpha > 0.0)
    data = np.where(is_seen, np.rint(100.0 * (1.0 - color / 255.0)), -1.0).astype(np.int8)
    position = {"x": first[0] * resolution_m, "y": first[1] * resolution_m}
    info = {
        "resolution": resolution_m,
        "width": int(width),
        "height": int(height),
        "origin": {"position": position, "orientation": {"w": 1.0}},
    }
    return {"info": info, "data": data.reshape(-1)}


def _corners(place: PlanarPose, texture: Texture) -> NDArray[np.float64]:
    """Return the corners of a picture (4, 2) [m]."""
    x, y, yaw = place
    along_y, along_x = (-length * texture.resolution_m for length in texture.alpha.shape[::-1])
    c, s = math.cos(yaw), math.sin(yaw)
    offsets = np.array([(0.0, 0.0), (along_x, 0.0), (0.0, along_y), (along_x, along_y)])
    return offsets @ np.array([[c, s], [-s, c]]) + (x, y)
