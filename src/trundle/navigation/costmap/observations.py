"""Recent observations of a sensor: points in the costmap's frame, from scans and clouds."""

import math
from collections import deque
from typing import TYPE_CHECKING, Any, NamedTuple

import msgspec
import numpy as np
from numpy.typing import NDArray

from trundle.gazebo.nodes.pointcloud_to_laserscan import read_points
from trundle.gazebo.nodes.rate import LogThrottle
from trundle.ros import Node, TransformBuffer, TransformError, to_nsec
from trundle.spatial import NS_PER_S, Pose, matrix_from_quaternion

from ..scan_messages import read_beams

if TYPE_CHECKING:
    from trundle.ros.message_types import sensor_msgs

_KEPT = 5
"""Number of messages that may wait for their transforms."""
_PATIENCE_NS = NS_PER_S
"""Age of a message from which a missing transform is reported."""
_CLOUDS = {"LaserScan": "sensor_msgs/LaserScan", "PointCloud2": "sensor_msgs/PointCloud2"}
_POINT_CLOUD = "sensor_msgs/PointCloud"


class SourceSettings(msgspec.Struct, kw_only=True):
    """Parameters of an observation source, with the original's defaults."""

    topic: str = ""
    sensor_frame: str = ""
    """Frame of the rays' origin; empty: the message's."""
    observation_persistence: float = 0.0
    """Time that observations are kept [s]; 0: only the latest."""
    expected_update_rate: float = 0.0
    """Longest time between two messages [s]; 0: unlimited."""
    data_type: str = "PointCloud"
    min_obstacle_height: float = 0.0
    max_obstacle_height: float = 2.0
    inf_is_valid: bool = False
    clearing: bool = False
    marking: bool = True
    obstacle_range: float = 2.5
    raytrace_range: float = 3.0


class Observation(NamedTuple):
    """Points of one message and the sensor's position, in the costmap's frame [m]."""

    stamp_ns: int
    sensor: tuple[float, float, float]
    points: NDArray[np.float64]
    """(n, 3)"""


class ObservationSource:
    """Keeps the latest observations of one topic."""

    def __init__(self, node: Node, settings: SourceSettings, frame: str, buffer: TransformBuffer) -> None:
        self.settings = settings
        self._node = node
        self._frame = frame
        self._buffer = buffer
        self._waiting: deque[Any] = deque(maxlen=_KEPT)
        self._kept: list[Observation] = []
        self._received_ns = node.clock.now_ns()
        self._warnings = LogThrottle(node, 5.0)
        kind = _CLOUDS.get(settings.data_type, _POINT_CLOUD)
        node.subscribe(settings.topic, kind, self._on_message, queue_size=_KEPT)

    def _on_message(self, message: Any) -> None:
        self._received_ns = self._node.clock.now_ns()
        self._waiting.append(message)

    @property
    def is_current(self) -> bool:
        """True if a message came within the expected time."""
        expected_ns = self.settings.expected_update_rate * NS_PER_S
        return expected_ns <= 0.0 or self._node.clock.now_ns() - self._received_ns <= expected_ns

    def clear(self) -> None:
        """Forget everything."""
        self._waiting.clear()
        self._kept.clear()

    def observations(self) -> list[Observation]:
        """Return the observations to use now: those not older than the persistence, and always the latest."""
        keep_ns = self.settings.observation_persistence * NS_PER_S
        latest_ns = self._node.clock.now_ns() - keep_ns
        while self._waiting:
            observation = self._read(self._waiting[-1 if keep_ns <= 0.0 else 0])
            if observation is not None:
                self._kept.append(observation)
            elif keep_ns <= 0.0 and len(self._waiting) > 1:
                self._try_older()
                break
            else:
                break
            if keep_ns <= 0.0:
                self._waiting.clear()
            else:
                self._waiting.popleft()
        self._kept = [item for item in self._kept if item.stamp_ns >= latest_ns] or self._kept[-1:]
        return self._kept

    def _try_older(self) -> None:
        """Use the newest message whose transform is known; messages after it wait on."""
        for index in range(len(self._waiting) - 2, -1, -1):
            observation = self._read(self._waiting[index])
            if observation is not None:
                self._kept.append(observation)
                for _ in range(index + 1):
                    self._waiting.popleft()
                return

    def _read(self, message: Any) -> Observation | None:
        """Return a message's points in the costmap's frame; None without a transform yet."""
        source, stamp_ns = message.header.frame_id.lstrip("/"), to_nsec(message.header.stamp)
        try:
            frame_from_points = self._buffer.lookup_transform(self._frame, source, stamp_ns).pose
            sensor = self.settings.sensor_frame.lstrip("/")
            frame_from_sensor = (
                self._buffer.lookup_transform(self._frame, sensor, stamp_ns).pose if sensor else frame_from_points
            )
        except TransformError as error:
            if self._node.clock.now_ns() - stamp_ns > _PATIENCE_NS:
                self._warnings.warn(f"{self.settings.topic}: no transform to {self._frame}: {error}")
            return None
        try:
            points = self._points(message)
        except ValueError as error:
            self._warnings.warn(f"{self.settings.topic}: a message is left out: {error}")
            points = np.empty((0, 3))
        points = _moved(points, frame_from_points)
        low, high = self.settings.min_obstacle_height, self.settings.max_obstacle_height
        is_used = (points[:, 2] >= low) & (points[:, 2] <= high)
        return Observation(stamp_ns, frame_from_sensor.position, points[is_used])

    def _points(self, message: Any) -> NDArray[np.float64]:
        match self.settings.data_type:
            case "LaserScan":
                return scan_points(message, inf_is_valid=self.settings.inf_is_valid)
            case "PointCloud2":
                points = read_points(message)
            case _:
                points = np.array([[p.x, p.y, p.z] for p in message.points], dtype=float).reshape(-1, 3)
        return points[np.isfinite(points).all(axis=1)]


def scan_points(scan: "sensor_msgs.LaserScan", *, inf_is_valid: bool) -> NDArray[np.float64]:
    """Return the points (n, 3) of a scan in its frame [m]; `inf_is_valid`: empty rays end just before range_max.

    Raises:
        ValueError: as `read_beams`.
    """
    ranges, angles = read_beams(scan)
    if inf_is_valid:
        ranges = np.where(ranges == math.inf, scan.range_max - 1e-4, ranges)
    is_used = (ranges >= scan.range_min) & (ranges < scan.range_max)
    ranges, angles = ranges[is_used], angles[is_used]
    return np.stack([ranges * np.cos(angles), ranges * np.sin(angles), np.zeros(len(ranges))], axis=1)


def _moved(points: NDArray[np.float64], pose: Pose) -> NDArray[np.float64]:
    return points @ matrix_from_quaternion(pose.quaternion).T + np.array(pose.position)
