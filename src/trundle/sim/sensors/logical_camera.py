"""Logical cameras: models in view and their poses."""

import math
from collections.abc import Callable, Mapping, Sequence

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.robots.model import LogicalCamera
from trundle.sim.simulation import Snapshot
from trundle.spatial import Pose, pose_from_row, transform_points

from .live_sensor import LiveSensor, SensorMount

DEFAULT_RATE_HZ = 30.0
"""Update rate of a camera whose update_rate is 0."""
_Points = NDArray[np.float64]


class ModelShapes(Struct, frozen=True, eq=False, kw_only=True):
    """Collision extents of a model."""

    name: str
    base_index: int
    """Index of the model's canonical link."""
    base_from_model: Pose
    corners: Mapping[int, _Points]
    """Link index → (n, 3) corners of the link's collision shapes in its frame [m]."""


class VisibleModel(Struct, frozen=True, kw_only=True):
    """Model in view."""

    name: str
    camera_from_model: Pose


class LogicalCameraReading(Struct, frozen=True, kw_only=True):
    """Models in view."""

    __module__ = "trundle"

    time_ns: int
    models: tuple[VisibleModel, ...]


class LogicalCameraSensor(LiveSensor[LogicalCameraReading]):
    """Camera that lists the other models whose axis-aligned bounding box of collisions intersects its frustum.

    As in Gazebo occluded models are in view too, and so is the ground: an infinite plane is the half space below it.
    """

    def __init__(self, mount: SensorMount, *, bodies: Callable[[], Sequence[ModelShapes]]) -> None:
        """Mount the sensor; see `LiveSensor`.

        Args:
            mount: model, link and sensor.
            bodies: returns all models.
        """
        super().__init__(mount, default_rate_hz=DEFAULT_RATE_HZ)
        assert isinstance(mount.sensor.instrument, LogicalCamera), f"{mount.sensor.name!r} is no logical camera"
        self._bodies = bodies
        self._planes = _frustum_planes(mount.sensor.instrument)

    def measure(self, snapshot: Snapshot) -> LogicalCameraReading:
        """List the models in view."""
        camera_from_world = self.world_from_sensor(snapshot).inverse()
        models: list[VisibleModel] = []
        for body in self._bodies():
            if body.name == self.model.name or not body.corners:
                continue
            points = np.concatenate(
                [transform_points(pose_from_row(snapshot.poses[i]), corners) for i, corners in body.corners.items()]
            )
            if not self._intersects(transform_points(camera_from_world, _bounding_box(points))):
                continue
            pose = camera_from_world @ pose_from_row(snapshot.poses[body.base_index]) @ body.base_from_model
            models.append(VisibleModel(name=body.name, camera_from_model=pose))
        return LogicalCameraReading(time_ns=snapshot.time_ns, models=tuple(models))

    def _intersects(self, corners: _Points) -> bool:
        """True if no frustum plane has all corners of a box outside."""
        outside = corners @ self._planes[:, :3].T < self._planes[:, 3]
        return not outside.all(axis=0).any()


def _frustum_planes(settings: LogicalCamera) -> _Points:
    """Return (6, 4) planes, normal and smallest n · p of points inside: near, far, left, right, top and bottom."""
    across = settings.horizontal_fov_rad / 2
    along = math.atan(math.tan(across) / settings.aspect_ratio)
    sides = [
        (math.sin(across), -math.cos(across), 0.0, 0.0),
        (math.sin(across), math.cos(across), 0.0, 0.0),
        (math.sin(along), 0.0, -math.cos(along), 0.0),
        (math.sin(along), 0.0, math.cos(along), 0.0),
    ]
    return np.array([(1.0, 0.0, 0.0, settings.near_m), (-1.0, 0.0, 0.0, -settings.far_m), *sides])


def _bounding_box(points: _Points) -> _Points:
    """Return the (8, 3) corners of the axis-aligned box around points."""
    low, high = points.min(axis=0), points.max(axis=0)
    return np.array([np.where(mask, high, low) for mask in np.ndindex(2, 2, 2)])
