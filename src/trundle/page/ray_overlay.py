"""Lines of range sensors on the page: rays and hit points of lidars, cones of sonars."""

import math
from collections.abc import Callable, Iterable

import numpy as np
from numpy.typing import NDArray

from trundle.page import Line
from trundle.sim.sensors import CameraSensor, InstrumentSensor, RangeReading, RangeSensor, SonarSensor, directions_of
from trundle.sim.simulation import Snapshot
from trundle.spatial import Pose, transform_points

_MAX_RAYS = 90
"""Limit of rays drawn per sensor; beyond it, every n-th ray is drawn."""
_MAX_POINTS = 20_000
"""Limit of points drawn per sensor; beyond it, every n-th point is drawn."""
_RIM_POINTS = 24
_BLUE = (90, 150, 255, 255)
_AMBER = (242, 177, 52, 255)


class RayOverlay:
    """Latest reading of each sensor, as lines."""

    def __init__(self, shown: Callable[[], bool], *, of_all: bool = False) -> None:
        """Create it; sensors are listened to only while their lines are shown.

        Args:
            shown: returns True if a browser shows the lines.
            of_all: True for all sensors, with the points that lidars hit, each id with its kind as prefix: `rays`,
                `points` or `sonars`; False for sensors with <visualize>.
        """
        self._shown = shown
        self._of_all = of_all
        self._hits: dict[RangeSensor, NDArray[np.float64]] = {}
        """Sensor → (points, 3) in its frame [m]."""
        self._ends: dict[RangeSensor | SonarSensor, NDArray[np.float64]] = {}
        """Sensor → (rays, 3) end points in its frame [m], for a sonar in its beam's frame."""
        self._listened: set[int] = set()

    def set_sensors(self, sensors: Iterable[CameraSensor | InstrumentSensor]) -> None:
        """Set the sensors to draw."""
        drawn = [sensor for sensor in sensors if isinstance(sensor, RangeSensor | SonarSensor)]
        drawn = [sensor for sensor in drawn if self._of_all or sensor.sensor.visualize]
        self._ends = {sensor: self._ends.get(sensor, np.zeros((0, 3))) for sensor in drawn}
        self._hits = {sensor: hits for sensor, hits in self._hits.items() if sensor in self._ends}
        for sensor in drawn:
            if id(sensor) in self._listened:
                continue
            self._listened.add(id(sensor))
            if isinstance(sensor, RangeSensor):
                self._listen_to_rays(sensor)
            else:
                self._listen_to_sonar(sensor)

    def lines(self, snapshot: Snapshot) -> tuple[Line, ...]:
        """Return the lines at the current sensor poses."""
        fans = (self._fan(sensor, snapshot, ends) for sensor, ends in self._ends.items() if len(ends))
        clouds = (self._cloud(sensor, snapshot, hits) for sensor, hits in self._hits.items() if len(hits))
        return (*fans, *clouds)

    def _listen_to_rays(self, sensor: RangeSensor) -> None:
        directions = directions_of(sensor.scan)
        chosen = np.arange(0, len(directions), -(-len(directions) // _MAX_RAYS))

        def store(reading: RangeReading) -> None:
            ranges = np.clip(reading.ranges.ravel()[chosen], sensor.scan.min_m, sensor.scan.max_m)
            self._ends[sensor] = directions[chosen] * ranges[:, None]
            if self._of_all:
                all_ranges = reading.ranges.ravel()
                hit = np.flatnonzero((all_ranges >= sensor.scan.min_m) & (all_ranges < sensor.scan.max_m))
                hit = hit[:: max(1, -(-len(hit) // _MAX_POINTS))]
                self._hits[sensor] = directions[hit] * all_ranges[hit][:, None]

        sensor.listen(store, enabled=lambda: sensor in self._ends and self._shown())

    def _listen_to_sonar(self, sensor: SonarSensor) -> None:
        half = min(sensor.fov_rad / 2.0, math.pi / 2.0)
        angles = np.linspace(0.0, math.tau, _RIM_POINTS, endpoint=False)
        rim = [np.full(_RIM_POINTS, math.cos(half)), math.sin(half) * np.cos(angles), math.sin(half) * np.sin(angles)]
        directions = np.stack(rim, axis=1)
        sensor.listen(
            lambda reading: self._ends.update({sensor: directions * reading.range_m}),
            enabled=lambda: sensor in self._ends and self._shown(),
        )

    def _fan(self, sensor: RangeSensor | SonarSensor, snapshot: Snapshot, ends: NDArray[np.float64]) -> Line:
        """Return a line along each ray."""
        world_from_rays = _world_from_rays(sensor, snapshot)
        points = np.empty((2 * len(ends), 3), dtype=np.float32)
        points[0::2] = world_from_rays.position
        points[1::2] = transform_points(world_from_rays, ends)
        kind = "sonars" if isinstance(sensor, SonarSensor) else "rays"
        name = f"{kind} {_name(sensor)}" if self._of_all else _name(sensor)
        return Line(id=name, rgba=_BLUE, points=points, kind="pairs")

    def _cloud(self, sensor: RangeSensor, snapshot: Snapshot, hits: NDArray[np.float64]) -> Line:
        """Return a point at the end of each ray."""
        points = transform_points(_world_from_rays(sensor, snapshot), hits).astype(np.float32)
        return Line(id=f"points {_name(sensor)}", rgba=_AMBER, points=points, kind="points")


def _name(sensor: RangeSensor | SonarSensor) -> str:
    return f"{sensor.model.name}::{sensor.parent_name}::{sensor.sensor.name}"


def _world_from_rays(sensor: RangeSensor | SonarSensor, snapshot: Snapshot) -> Pose:
    if isinstance(sensor, SonarSensor):
        return sensor.world_from_link(snapshot) @ sensor.link_from_beam
    return sensor.world_from_sensor(snapshot)
