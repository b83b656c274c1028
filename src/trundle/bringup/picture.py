"""`trundle render`: one picture of what a file describes, from a camera of its own or from a good side."""

import math
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from trundle.diagnostics import Diagnostics, UsageError
from trundle.packages import Packages
from trundle.render import Intrinsics, NativeRenderer, Scene, corners_of, scene_of
from trundle.sensors import CameraSensor, mount_cameras
from trundle.simulation import Simulation
from trundle.spatial import Pose

from .outcome import pose_of
from .stage import set_stage

DEFAULT_SIZE = (800, 600)
_FOV = 0.6
"""A long lens: little distortion, as in a product picture [rad]."""
_FROM = (math.radians(-38.0), math.radians(16.0))
"""Azimuth and elevation of a three-quarter view: on the side that Gazebo's sun shines on."""
_MARGIN = 1.08
_SAMPLES = 2
"""Pictures are drawn twice as large and averaged: smooth edges."""
_MOST_PX = 3840 * 2160
"""A picture of that many pixels takes 3.3 GB to draw, measured; memory grows in proportion."""


def picture_of(
    file: str,
    environment: Mapping[str, str],
    report: Diagnostics,
    *,
    start: Path,
    camera: str | None = None,
    size: tuple[int, int] | None = None,
    depth: bool = False,
) -> Image.Image:
    """Draw a file as it is at time zero.

    Args:
        file: as for `trundle run`.
        environment: says where packages and models are.
        report: takes findings.
        start: packages are looked for around it too.
        camera: a camera sensor's name; None: a view of everything that is not the ground.
        size: width and height [px].
        depth: distances [mm] as 16 bit grey instead of colours; 0 where nothing is.

    Raises:
        DescriptionError: the file is at fault.
        UsageError: no such camera, or a picture too large to draw.
    """
    stage = set_stage(file, Packages(environment, start=start), report)
    simulation = Simulation(stage.world, report)
    poses = simulation.snapshot().poses
    scene = scene_of(stage.world, report)
    renderer = NativeRenderer(scene)
    if camera is not None:
        sensor = _camera(camera, mount_cameras(stage.world, lambda _: renderer, report))
        view = pose_of(poses[sensor.link_index]) @ sensor.link_from_camera
        intrinsics = sensor.intrinsics
        if size is not None:
            intrinsics = replace(intrinsics, width_px=size[0], height_px=size[1])
    else:
        width, height = size or DEFAULT_SIZE
        intrinsics = Intrinsics(width_px=width, height_px=height, horizontal_fov_rad=_FOV, near_m=0.01, far_m=1000.0)
        view = _good_side(scene, poses, intrinsics)
    if intrinsics.width_px * intrinsics.height_px > _MOST_PX:
        asked = f"{intrinsics.width_px}x{intrinsics.height_px}"
        raise UsageError(f"a picture of {asked} is too large; it may have {_MOST_PX} pixels, as 3840x2160 has")
    renderer.update(poses)
    if depth:
        ranges = renderer.render(view, intrinsics, depth=True).depth
        assert ranges is not None
        millimetres = np.where(np.isfinite(ranges), np.minimum(ranges * 1000.0, 65535.0), 0.0)
        return Image.fromarray(millimetres.astype(np.uint16))
    large = replace(intrinsics, width_px=intrinsics.width_px * _SAMPLES, height_px=intrinsics.height_px * _SAMPLES)
    picture = Image.fromarray(renderer.render(view, large).rgb)
    return picture.resize((intrinsics.width_px, intrinsics.height_px), Image.Resampling.BOX)


def _camera(name: str, cameras: list[CameraSensor]) -> CameraSensor:
    for camera in cameras:
        if camera.name == name:
            return camera
    there = ", ".join(repr(camera.name) for camera in cameras) or "none"
    raise UsageError(f"no camera {name!r}; cameras there: {there}")


def _good_side(scene: Scene, poses: NDArray[np.float64], intrinsics: Intrinsics) -> Pose:
    """A three-quarter view that holds everything but endless planes."""
    corners = [corners_of(shape.geometry) for shape in scene.shapes]
    points = [
        (pose_of(poses[shape.body]) @ shape.body_from_shape).point(corner)
        for shape, box in zip(scene.shapes, corners, strict=True)
        for corner in box
    ]
    cloud = np.array(points or [(-1.0, -1.0, 0.0), (1.0, 1.0, 1.0)])
    middle = (cloud.min(axis=0) + cloud.max(axis=0)) / 2
    azimuth, elevation = _FROM
    away = np.array(
        [math.cos(elevation) * math.cos(azimuth), math.cos(elevation) * math.sin(azimuth), math.sin(elevation)]
    )
    rotation = Pose.from_rpy(0.0, 0.0, 0.0, 0.0, elevation, azimuth + math.pi)
    in_view = np.array([rotation.inverse().direction((x, y, z)) for x, y, z in (cloud - middle).tolist()])
    half_width = math.tan(intrinsics.horizontal_fov_rad / 2)
    half_height = half_width * intrinsics.height_px / intrinsics.width_px
    needed = np.maximum(np.abs(in_view[:, 1]) / half_width, np.abs(in_view[:, 2]) / half_height) - in_view[:, 0]
    x, y, z = (middle + away * float(needed.max()) * _MARGIN).tolist()
    return Pose((x, y, z), rotation.quaternion)
