"""Topics of teb_local_planner besides its plans: poses, markers, feedback; obstacles and via points."""

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from trundle.ros import Node, TransformBuffer, TransformError

from ...costmap import CostmapRos
from .candidates import Candidate

_LINE_STRIP, _LINE_LIST = 4, 5
_MAX_POINTS = 5000
_SPACING_M = 0.05
_COLORS = ({"r": 1.0, "a": 1.0}, {"b": 1.0, "a": 1.0})
"""Colors of the selected band and of the other candidates."""


class BandTopics:
    """`teb_poses`, `teb_markers` and `teb_feedback` out; `obstacles` and `via_points` in."""

    def __init__(self, node: Node, name: str, costmap: CostmapRos, buffer: TransformBuffer) -> None:
        self._node = node
        self._costmap = costmap
        self._buffer = buffer
        self._poses = node.advertise(f"~{name}/teb_poses", "geometry_msgs/PoseArray", queue_size=100)
        self._markers = node.advertise(f"~{name}/teb_markers", "visualization_msgs/Marker", queue_size=1000)
        self._feedback = node.advertise(f"~{name}/teb_feedback", "teb_local_planner/FeedbackMsg", queue_size=10)
        kind = "costmap_converter/ObstacleArrayMsg"
        node.subscribe(f"~{name}/obstacles", kind, self._on_obstacles, queue_size=1)
        node.subscribe(f"~{name}/via_points", "nav_msgs/Path", self._on_via_points, queue_size=1)
        self._obstacles: tuple[str, NDArray[np.float64]] = ("", np.empty((0, 2)))
        self._via_points: tuple[str, NDArray[np.float64]] = ("", np.empty((0, 2)))

    @property
    def obstacles(self) -> NDArray[np.float64]:
        """Points (n, 2) of the obstacles received last, in the costmap's frame [m]."""
        return self._moved(*self._obstacles)

    @property
    def via_points(self) -> NDArray[np.float64] | None:
        """Points (n, 2) received last, in the costmap's frame [m]; None before the first message."""
        return self._moved(*self._via_points) if self._via_points[0] else None

    def _moved(self, frame: str, points: NDArray[np.float64]) -> NDArray[np.float64]:
        if not len(points) or frame == self._costmap.frame:
            return points
        try:
            pose = self._buffer.lookup_transform(self._costmap.frame, frame).pose
        except TransformError as error:
            self._node.log.warn(f"points in the frame {frame} are left out: {error}")
            return np.empty((0, 2))
        return np.array([pose.transform_point((x, y, 0.0))[:2] for x, y in points.tolist()])

    def _on_obstacles(self, message: Any) -> None:
        points: list[NDArray[np.float64]] = []
        for obstacle in message.obstacles:
            corners = np.array([(corner.x, corner.y) for corner in obstacle.polygon.points], float).reshape(-1, 2)
            points.append(_outline(corners, float(obstacle.radius)))
        self._obstacles = (message.header.frame_id.lstrip("/") or self._costmap.frame, self._checked(points))

    def _on_via_points(self, message: Any) -> None:
        points = [(stamped.pose.position.x, stamped.pose.position.y) for stamped in message.poses]
        frame = message.header.frame_id.lstrip("/") or self._costmap.frame
        self._via_points = (frame, self._checked([np.array(points, float).reshape(-1, 2)]))

    def _checked(self, parts: list[NDArray[np.float64]]) -> NDArray[np.float64]:
        points = np.vstack([np.empty((0, 2)), *parts])
        is_usable = (np.abs(points) < 1e5).all(axis=1)
        kept = points[is_usable][:_MAX_POINTS]
        if len(kept) < len(points):
            self._node.log.warn(
                f"{len(points) - len(kept)} points are ignored: they are not finite, or more than {_MAX_POINTS}"
            )
        return kept

    def publish(self, best: Candidate, bands: list[Candidate], velocities: NDArray[np.float64]) -> None:
        """Publish the bands; `velocities` (n, 3) of the selected one are sent only with `publish_feedback`."""
        header = {"stamp": self._node.clock.now_ns(), "frame_id": self._costmap.frame}
        if self._poses.has_subscribers:
            self._poses.publish({"header": header, "poses": [_pose(row) for row in best.band.poses.tolist()]})
        if self._markers.has_subscribers:
            common = {"header": header, "pose": {"orientation": {"w": 1.0}}, "scale": {"x": 0.01}}
            path = [{"x": x, "y": y} for x, y, _ in best.band.poses.tolist()]
            self._markers.publish(
                {**common, "ns": "LocalPlannerPath", "type": _LINE_STRIP, "color": _COLORS[0], "points": path}
            )
            lines = [
                {"x": x, "y": y}
                for candidate in bands
                for pair in zip(candidate.band.poses[:-1].tolist(), candidate.band.poses[1:].tolist(), strict=True)
                for x, y, _ in pair
            ]
            self._markers.publish(
                {**common, "ns": "TebContainer", "type": _LINE_LIST, "color": _COLORS[1], "points": lines}
            )
        if len(velocities) and self._feedback.has_subscribers:
            self._feedback.publish({"header": header, **_feedback(best, bands, velocities, header)})


def _outline(corners: NDArray[np.float64], radius: float) -> NDArray[np.float64]:
    """Return points (n, 2) along an obstacle: a point, a circle, a line or a closed polygon [m]."""
    if len(corners) == 1 and 0.0 < radius < 1e3:
        count = min(max(math.ceil(2.0 * math.pi * radius / _SPACING_M), 8), _MAX_POINTS)
        angles = np.arange(count) * (2.0 * math.pi / count)
        return corners + radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    if len(corners) < 2:
        return corners
    ends = np.roll(corners, -1, axis=0) if len(corners) > 2 else corners[::-1][:1]
    parts: list[NDArray[np.float64]] = []
    for start, end in zip(corners, ends, strict=False):
        length = float(np.hypot(*(end - start)))
        count = min(math.ceil(length / _SPACING_M), _MAX_POINTS) if math.isfinite(length) else 0
        parts.append(start + np.linspace(0.0, 1.0, count + 1)[:, None] * (end - start))
    return np.vstack(parts)


def _pose(row: list[float]) -> dict[str, Any]:
    x, y, yaw = row
    return {"position": {"x": x, "y": y}, "orientation": {"z": math.sin(yaw / 2.0), "w": math.cos(yaw / 2.0)}}


def _feedback(
    best: Candidate, bands: list[Candidate], velocities: NDArray[np.float64], header: dict[str, Any]
) -> dict[str, Any]:
    trajectories: list[dict[str, Any]] = []
    for candidate in bands:
        times = np.append(0.0, np.cumsum(candidate.band.steps))
        points: list[dict[str, Any]] = []
        for i, (row, time_s) in enumerate(zip(candidate.band.poses.tolist(), times.tolist(), strict=True)):
            point: dict[str, Any] = {"pose": _pose(row), "time_from_start": int(time_s * 1e9)}
            if candidate is best:
                x, y, turn = velocities[min(i, len(velocities) - 1)].tolist()
                point["velocity"] = {"linear": {"x": x, "y": y}, "angular": {"z": turn}}
            points.append(point)
        trajectories.append({"header": header, "trajectory": points})
    return {"trajectories": trajectories, "selected_trajectory_idx": bands.index(best)}
