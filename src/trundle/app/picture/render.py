"""Images of a description, from one of its cameras or in a three-quarter view."""

import itertools
from collections.abc import Mapping
from colorsys import hsv_to_rgb
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

import numpy as np
from msgspec.structs import replace
from numpy.typing import NDArray
from PIL import Image

from trundle.base.diagnostics import Diagnostics, UsageError
from trundle.live.world_setup import load_world
from trundle.robots.lint.empty_scene import empty_reason
from trundle.robots.model import World
from trundle.robots.packages import Packages
from trundle.robots.robot import Robot, root_from_links
from trundle.sim.render import (
    Intrinsics,
    Picture,
    Scene,
    report_unreadable_textures,
    scene_from_world,
    update_skins,
)
from trundle.sim.renderers import RENDERERS, RendererName
from trundle.sim.sensors import CameraProjection, CameraSensor, PinholeProjection, mount_cameras
from trundle.sim.simulation import Simulation, Snapshot
from trundle.sim.three_quarter_view import BACKDROP, FIELD_OF_VIEW, STUDIO_LIGHT, scene_corners, three_quarter_pose
from trundle.spatial import pose_from_row, rows_from_poses

from .lowest_point import lowest_point

DEFAULT_SIZE = (800, 600)
_SAMPLES = 2
"""Supersampling per axis, against jagged edges."""
_MAX_PX = 3840 * 2160
_LOOK_S = 0.1
"""Period at which a video's motion is looked at beforehand [s]."""
_REACH = 3.0
"""Limit of the distance from the middle of a scene, per its radius, of what moves and still belongs to it."""
_GOLDEN = 0.61803398875
_COLORS = [(0.0, 0.0, 0.0)] + [hsv_to_rgb(i * _GOLDEN % 1.0, 0.5 + i % 3 * 0.2, 1.0 - i % 2 * 0.3) for i in range(255)]
_PALETTE = np.round(np.array(_COLORS) * 255.0).astype(np.uint8)
"""(256, 3) RGB: black for the background, then colors; consecutive ones differ much."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PictureOptions:
    """Options of a picture."""

    camera: str | None = None
    """Camera sensor's name; None: a three-quarter view of everything but planes."""
    size: tuple[int, int] | None = None
    """Width and height [px]; None: the camera's, or 800 × 600."""
    content: Literal["color", "depth", "segmentation"] = "color"
    """Depth is uint16 in millimetres, 0 for the background; segmentation has a color per visual."""
    at_s: float = 0.0
    """Simulated time of the picture [s]."""
    renderer: RendererName = "cpu"


class PictureRenderer:
    """Renderer of one file."""

    def __init__(
        self, file: str, environment: Mapping[str, str], report: Diagnostics, *, start: Path, options: PictureOptions
    ) -> None:
        """Read a file and simulate it up to the picture's time.

        Args:
            file: see `trundle run`.
            environment: environment variables that locate packages and models.
            report: collects all findings.
            start: packages are searched around it too.
            options: picture options.

        Raises:
            DescriptionError: the file cannot be read.
            UsageError: no such camera, or too large a picture.
        """
        packages = Packages(environment, start=start)
        loaded = load_world(file, packages, report)
        self._content = options.content
        self.empty_reason = empty_reason(loaded.flat)
        """Reason why the picture is empty, or drawn from the URDF without physics; None if it is neither."""
        self.simulation = Simulation(loaded.flat, report)
        scene = scene_from_world(loaded.flat, report)
        self._static_poses: NDArray[np.float64] = np.zeros((0, 7))
        """(N, 7) poses of bodies that are drawn but not simulated."""
        robot = loaded.robot if options.camera is None and not _has_visuals(loaded.flat) else None
        if robot is not None and any(link.visuals for link in robot.links):
            self.empty_reason = "it cannot be simulated; it is drawn as in the file"
            scene, self._static_poses = _add_robot(scene, robot, packages, report)
        if options.camera is None:
            scene = replace(scene, ambient=STUDIO_LIGHT, background=BACKDROP)
        self._scene, self._renderer = scene, RENDERERS[options.renderer](scene)
        report_unreadable_textures(scene, report)
        self._sensor: CameraSensor | None = None
        width, height = options.size or DEFAULT_SIZE
        self._lens = Intrinsics(
            width_px=width, height_px=height, horizontal_fov_rad=FIELD_OF_VIEW, near_m=0.01, far_m=1000.0
        )
        if options.camera is not None:
            self._sensor = _camera(options.camera, mount_cameras(self.simulation, lambda _: self._renderer))
            self._lens = self._sensor.intrinsics
            if options.content == "depth" and self._sensor.optics.lens is not None:
                raise UsageError(f"camera {options.camera!r} is a wide-angle camera; depth needs a pinhole camera")
            if options.size is not None and not self._sensor.is_pinhole:
                camera_size = f"{self._lens.width_px}x{self._lens.height_px}"
                raise UsageError(
                    f"camera {options.camera!r} has a lens; the size of its picture is fixed, {camera_size}"
                )
            if options.size is not None:
                self._lens = replace(self._lens, width_px=width, height_px=height)
        if self._lens.width_px * self._lens.height_px > _MAX_PX:
            size = f"{self._lens.width_px}x{self._lens.height_px}"
            raise UsageError(f"a picture of {size} is too large; it may have {_MAX_PX} pixels, as 3840x2160 has")
        if options.at_s > 0.0:
            self.simulation.run(options.at_s)
        added = [options.camera is None and model.added for model in loaded.flat.models for _ in model.links]
        self._ground = np.flatnonzero(added)
        self._ground_offset_m = 0.0
        self._cloud = scene_corners(scene, self._poses(self.simulation.snapshot()))
        rows = self._poses(self.simulation.snapshot())
        heights = [
            lowest_point(shape.geometry, pose_from_row(rows[shape.body]) @ shape.body_from_shape)
            for shape in scene.shapes
        ]
        self._ground_offset_m = min([0.0, *heights])

    def _poses(self, snapshot: Snapshot) -> NDArray[np.float64]:
        """Return the poses to draw; the added ground plane is lowered to the lowest point, to hide nothing."""
        poses = np.concatenate([snapshot.poses, self._static_poses])
        poses[self._ground, 2] += self._ground_offset_m
        return poses

    def include_motion(self, duration_s: float) -> None:
        """Let the three-quarter view contain what moves in the coming seconds, but for what leaves the scene."""
        if self._sensor is not None:
            return
        middle = (self._cloud.min(axis=0) + self._cloud.max(axis=0)) / 2
        reach = _REACH * float(np.linalg.norm(self._cloud - middle, axis=1).max())
        low, high = self._cloud.min(axis=0), self._cloud.max(axis=0)
        state = self.simulation.save()
        for _ in range(round(duration_s / _LOOK_S)):
            self.simulation.run(_LOOK_S)
            points = scene_corners(self._scene, self._poses(self.simulation.snapshot()))
            near = points[np.linalg.norm(points - middle, axis=1) <= reach]
            low = np.minimum(low, near.min(axis=0, initial=np.inf))
            high = np.maximum(high, near.max(axis=0, initial=-np.inf))
        self.simulation.restore(state)
        self._cloud = np.array(list(itertools.product(*zip(low.tolist(), high.tolist(), strict=True))))

    def render(self, *, turned_rad: float = 0.0) -> Image.Image:
        """Draw the current state; `turned_rad` turns the three-quarter view about z, counter-clockwise from above."""
        snapshot = self.simulation.snapshot()
        self._renderer.update(self._poses(snapshot))
        update_skins(self._renderer, self._scene, self.simulation.animation_state)
        if self._sensor is not None:
            world_from_camera = self._sensor.world_from_camera(snapshot)
        else:
            world_from_camera = three_quarter_pose(self._cloud, self._lens, turned_rad)
        distorted = None if self._sensor is None or self._sensor.is_pinhole else self._sensor.projection

        def render_view(view: CameraProjection, *, depth: bool = False, segmentation: bool = False) -> Picture:
            views = [(world_from_camera @ face, lens) for face, lens in view.pinhole_views]
            return view.compose(self._renderer.render(views, depth=depth, segmentation=segmentation))

        view = distorted or PinholeProjection(self._lens)
        if self._content == "depth":
            ranges = render_view(view, depth=True).depth
            assert ranges is not None
            millimetres = np.where(np.isfinite(ranges), np.minimum(ranges * 1000.0, 65535.0), 0.0)
            return Image.fromarray(millimetres.astype(np.uint16))
        if self._content == "segmentation":
            segments = render_view(view, segmentation=True).segmentation
            assert segments is not None
            return Image.fromarray(_PALETTE[np.where(segments < 0, 0, segments % (len(_PALETTE) - 1) + 1)])
        if distorted is not None:
            return Image.fromarray(render_view(distorted).rgb)
        width, height = self._lens.width_px, self._lens.height_px
        large = replace(self._lens, width_px=width * _SAMPLES, height_px=height * _SAMPLES)
        picture = Image.fromarray(render_view(PinholeProjection(large)).rgb)
        return picture.resize((width, height), Image.Resampling.BOX)


def _has_visuals(world: World) -> bool:
    """True if a model of the file has a visual, apart from the added ground."""
    return any(link.visuals for model in world.models if not model.added for link in model.links)


def _camera(name: str, cameras: list[CameraSensor]) -> CameraSensor:
    for camera in cameras:
        if camera.name == name:
            return camera
    names = ", ".join(repr(camera.name) for camera in cameras) or "none"
    raise UsageError(f"no camera {name!r}; cameras there: {names}")


def _add_robot(
    scene: Scene, robot: Robot, packages: Packages, report: Diagnostics
) -> tuple[Scene, NDArray[np.float64]]:
    """Add a URDF that cannot be simulated, such as one without masses, on the ground with joints at zero.

    Returns:
        The scene with the robot's links as further bodies, and their (links, 7) poses in the world.
    """
    from .robot_scene import robot_scene  # slow to import; other pictures do not need it

    robot_part = robot_scene(robot, packages, report)
    poses = root_from_links(robot, {})
    links = [poses[name] for name in robot_part.bodies]
    heights = [lowest_point(shape.geometry, links[shape.body] @ shape.body_from_shape) for shape in robot_part.shapes]
    rows = rows_from_poses(links)
    rows[:, 2] -= min(heights, default=0.0)
    first = len(scene.bodies)
    moved = tuple(replace(shape, body=shape.body + first) for shape in robot_part.shapes)
    return replace(scene, bodies=(*scene.bodies, *robot_part.bodies), shapes=(*scene.shapes, *moved)), rows
