"""What is drawn about the robot but is no part of it: its frames, what its cameras see, where it has been."""

import math

import numpy as np
import viser
from numpy.typing import NDArray

from trundle.spatial import Pose, compose_rows, finite_rows, rows_from_poses

from .content import CameraView, FrameInfo

_CAMERA_FROM_OPTICAL = Pose(quaternion=(0.5, -0.5, 0.5, -0.5))
"""A frustum looks along its +z with y down, a robot's camera along +x with z up."""
_MAX_NAMES = 100
"""Above this many frames their names would only hide each other."""
_PATH_STEP_M = 0.1
_PATH_ARROWS = 500
_LEAP_M = 1.0
_PATH_COLOR = (235, 8, 0)
"""Steps of 0.1 m and a red are what rviz's Odometry display starts with; viser lightens it."""


class Frames:
    """Axes, names, and a line from each frame to its parent, as rviz's TF display."""

    def __init__(self, server: viser.ViserServer, folder: str, frames: tuple[FrameInfo, ...]) -> None:
        self._server = server
        self._folder = folder
        self._names = [frame.name for frame in frames]
        index = {frame.name: i for i, frame in enumerate(frames)}
        edges = [(i, index[f.parent]) for i, f in enumerate(frames) if f.parent in index]
        self._edges = np.array(edges, dtype=np.int64).reshape(-1, 2)
        self._top = server.scene.add_frame(folder, show_axes=False, visible=False)
        self._labels: list[viser.LabelHandle] = []
        self._lines: viser.LineSegmentsHandle | None = None
        self._axes: viser.BatchedAxesHandle | None = None
        self._shown: NDArray[np.bool_] = np.zeros(0, dtype=bool)

    def resize(self, radius: float) -> None:
        """Draw the frames at a size that suits a robot of this radius [m]."""
        count = len(self._names)
        if count == 0:
            return
        length = 0.4 * radius
        self._axes = self._server.scene.add_batched_axes(
            f"{self._folder}/axes",
            batched_wxyzs=np.tile([1.0, 0.0, 0.0, 0.0], (count, 1)),
            batched_positions=np.zeros((count, 3)),
            batched_scales=np.zeros(count),
            axes_length=length,
            axes_radius=0.03 * length,
        )
        self._lines = self._server.scene.add_line_segments(
            f"{self._folder}/edges",
            points=np.zeros((max(len(self._edges), 1), 2, 3), dtype=np.float32),
            colors=(240, 200, 40),
            thickness=0.008 * radius,
        )
        self._labels = [
            self._server.scene.add_label(f"{self._folder}/names/{i}", name, visible=False, font_screen_scale=0.9)
            for i, name in enumerate(self._names[:_MAX_NAMES])
        ]

    def update(self, poses: NDArray[np.float64], *, axes: bool, names: bool) -> None:
        """Put axes, lines and names where the frames are; a frame without a pose is not drawn."""
        if self._top.visible != axes:
            self._top.visible = axes
        if not axes or self._axes is None or self._lines is None:
            return
        there = finite_rows(poses)
        drawn = np.where(there[:, None], poses, (0.0, 0, 0, 1, 0, 0, 0))
        self._axes.batched_positions = drawn[:, :3].astype(np.float32)
        self._axes.batched_wxyzs = drawn[:, 3:].astype(np.float32)
        if not np.array_equal(there, self._shown):
            self._shown = there
            self._axes.batched_scales = np.asarray(there, dtype=np.float32)
        if len(self._edges):
            ends = drawn[self._edges, :3]
            ends[~there[self._edges].all(axis=1)] = 0.0
            self._lines.points = ends.astype(np.float32)
        for label, is_known, position in zip(self._labels, there, drawn[:, :3], strict=False):
            if label.visible != (names and bool(is_known)):
                label.visible = names and bool(is_known)
            if label.visible:
                label.position = position


class Frusta:
    """What each camera sees, as a pyramid with the live image on its base."""

    def __init__(self, server: viser.ViserServer, folder: str, cameras: tuple[CameraView, ...]) -> None:
        self._top = server.scene.add_frame(folder, show_axes=False)
        self._handles: list[viser.CameraFrustumHandle | None] = []
        self._cameras = cameras
        self._body_from_optical = rows_from_poses([c.body_from_camera @ _CAMERA_FROM_OPTICAL for c in cameras])
        for i, camera in enumerate(cameras):
            if camera.body is None:
                self._handles.append(None)
                continue
            aspect = camera.width_px / camera.height_px
            handle = server.scene.add_camera_frustum(
                f"{folder}/{i}",
                fov=2 * math.atan(math.tan(min(camera.horizontal_fov_rad, 3.0) / 2) / aspect),
                aspect=aspect,
                color=(250, 250, 250),
                cast_shadow=False,
                receive_shadow=False,
                visible=False,
            )
            self._handles.append(handle)

    def resize(self, radius: float) -> None:
        """Draw the pyramids at a size that suits a robot of this radius [m]."""
        for handle in self._handles:
            if handle is not None:
                handle.scale = 0.2 * radius
                handle.thickness = 0.004 * radius

    def update(self, body_poses: NDArray[np.float64], *, shown: bool) -> None:
        """Put the pyramids on their bodies."""
        if self._top.visible != shown:
            self._top.visible = shown
        if not shown:
            return
        for camera, handle, body_from_optical in zip(
            self._cameras, self._handles, self._body_from_optical, strict=True
        ):
            if camera.body is None or handle is None:
                continue
            pose = compose_rows(body_poses[camera.body : camera.body + 1], body_from_optical[None])[0]
            seen = bool(np.isfinite(pose).all())
            if handle.visible != seen:
                handle.visible = seen
            if seen:
                handle.position, handle.wxyz = pose[:3], pose[3:]

    def image(self, index: int, rgb: NDArray[np.uint8]) -> None:
        """Show a camera's newest image on its pyramid."""
        handle = self._handles[index]
        if handle is not None:
            handle.image = rgb


def arrows_along(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Join points (N, 3) by arrows (M, 2, 3) from each to the next; a leap (a reset, a respawn) is no way driven."""
    arrows = np.stack([points[:-1], points[1:]], axis=1)
    return arrows[np.linalg.norm(arrows[:, 1] - arrows[:, 0], axis=1) < _LEAP_M]


class Path:
    """Where the followed body has been, as arrows along its way."""

    def __init__(self, server: viser.ViserServer, name: str) -> None:
        self._server = server
        self._name = name
        self._points: list[NDArray[np.float64]] = []
        self._time_ns = 0
        self._drawn = 0
        self._handle: viser.ArrowsHandle | None = None
        self._shaft_m = 0.01

    def resize(self, radius: float) -> None:
        """Draw arrows of a size that suits a robot of this radius [m]."""
        self._shaft_m = min(0.02 * radius, 0.1 * _PATH_STEP_M)

    def update(self, time_ns: int, followed: NDArray[np.float64] | None, *, shown: bool) -> None:
        """Note where the body is, and draw the path if it is shown; time that runs back starts a new one."""
        if time_ns < self._time_ns:
            self._points.clear()
        self._time_ns = time_ns
        if followed is not None and np.isfinite(followed).all():
            here = followed[:3]
            if not self._points or float(np.linalg.norm(here - self._points[-1])) >= _PATH_STEP_M:
                self._points = [*self._points[-_PATH_ARROWS:], here.copy()]
                self._drawn = 0
        wanted = len(self._points) if shown else 0
        if wanted == self._drawn:
            return
        self._drawn = wanted
        if self._handle is not None:
            self._handle.remove()
            self._handle = None
        if wanted >= 2:
            self._handle = self._server.scene.add_arrows(
                self._name,
                points=arrows_along(np.array(self._points)),
                colors=_PATH_COLOR,
                shaft_radius=self._shaft_m,
                head_radius=2.4 * self._shaft_m,
                head_length=4.0 * self._shaft_m,
            )
