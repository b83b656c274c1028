"""Lines on the page of range sensors: the rays of lidars and what they hit, the cones of sonars."""

import math
from collections.abc import Callable, Iterable

import numpy as np
from numpy.typing import NDArray

from trundle.page import Line
from trundle.sim.sensors import CameraSensor, InstrumentSensor, RangeReading, RangeSensor, SonarSensor, directions_of
from trundle.sim.simulation import Snapshot
from trundle.spatial import Pose, transform_points

_MAX_RAYS = 90
"""Rays drawn per sensor; of more, every n-th."""
_MAX_POINTS = 20_000
"""Points drawn per sensor; of more, every n-th."""
_RIM = 24
_BLUE = (90, 150, 255, 255)
_AMBER = (242, 177, 52, 255)


class RayOverlay:
    """Keeper of each sensor's last reading."""

    def __init__(self, shown: Callable[[], bool], *, of_all: bool = False) -> None:
        """Prepare; readings are taken only while they are shown.

        Args:
            shown: True if a browser shows them.
            of_all: True for all sensors, with the points that lidars hit, each id behind the word for its kind: `rays`,
                `points`, `sonars`; False for those with <visualize>.
        """
        self._shown = shown
        self._of_all = of_all
        self._hits: dict[RangeSensor, NDArray[np.float64]] = {}
        """Sensor → (points, 3) in its frame [m]."""
        self._ends: dict[RangeSensor | SonarSensor, NDArray[np.float64]] = {}
        """Sensor → (rays, 3) end points in its frame [m]; a sonar's are in its beam's frame."""
        self._listened: set[int] = set()

    def set_sensors(self, sensors: Iterable[CameraSensor | InstrumentSensor]) -> None:
        """Set the sensors to draw."""
        seen = [each for each in sensors if isinstance(each, RangeSensor | SonarSensor)]
        seen = [each for each in seen if self._of_all or each.sensor.visualize]
        self._ends = {sensor: self._ends.get(sensor, np.zeros((0, 3))) for sensor in seen}
        self._hits = {sensor: hits for sensor, hits in self._hits.items() if sensor in self._ends}
        for sensor in seen:
            if id(sensor) in self._listened:
                continue
            self._listened.add(id(sensor))
            if isinstance(sensor, RangeSensor):
                self._listen_to_rays(sensor)
            else:
                self._listen_to_sonar(sensor)

    def lines(self, snapshot: Snapshot) -> tuple[Line, ...]:
        """Rays at the current sensor poses."""
        fans = (self._fan(sensor, snapshot, ends) for sensor, ends in self._ends.items() if len(ends))
        clouds = (self._cloud(sensor, snapshot, hits) for sensor, hits in self._hits.items() if len(hits))
        return (*fans, *clouds)

    def _listen_to_rays(self, sensor: RangeSensor) -> None:
        directions = directions_of(sensor.scan)
        chosen = np.arange(0, len(directions), -(-len(directions) // _MAX_RAYS))

        def keep(reading: RangeReading) -> None:
            ranges = np.clip(reading.ranges.ravel()[chosen], sensor.scan.min_m, sensor.scan.max_m)
            self._ends[sensor] = directions[chosen] * ranges[:, None]
            if self._of_all:
                every = reading.ranges.ravel()
                hit = np.flatnonzero((every >= sensor.scan.min_m) & (every < sensor.scan.max_m))
                hit = hit[:: max(1, -(-len(hit) // _MAX_POINTS))]
                self._hits[sensor] = directions[hit] * every[hit][:, None]

        sensor.listen(keep, enabled=lambda: sensor in self._ends and self._shown())

    def _listen_to_sonar(self, sensor: SonarSensor) -> None:
        half = min(sensor.fov_rad / 2.0, math.pi / 2.0)
        turns = np.linspace(0.0, math.tau, _RIM, endpoint=False)
        rim = [np.full(_RIM, math.cos(half)), math.sin(half) * np.cos(turns), math.sin(half) * np.sin(turns)]
        directions = np.stack(rim, axis=1)
        sensor.listen(
            lambda reading: self._ends.update({sensor: directions * reading.range_m}),
            enabled=lambda: sensor in self._ends and self._shown(),
        )

    def _fan(self, sensor: RangeSensor | SonarSensor, snapshot: Snapshot, ends: NDArray[np.float64]) -> Line:
        """A line along each ray."""
        world_from_rays = _place(sensor, snapshot)
        points = np.empty((2 * len(ends), 3), dtype=np.float32)
        points[0::2] = world_from_rays.position
        points[1::2] = transform_points(world_from_rays, ends)
        kind = "sonars" if isinstance(sensor, SonarSensor) else "rays"
        name = f"{kind} {_name(sensor)}" if self._of_all else _name(sensor)
        return Line(id=name, rgba=_BLUE, points=points, kind="pairs")

    def _cloud(self, sensor: RangeSensor, snapshot: Snapshot, hits: NDArray[np.float64]) -> Line:
        """A point where each ray ends."""
        points = transform_points(_place(sensor, snapshot), hits).astype(np.float32)
        return Line(id=f"points {_name(sensor)}", rgba=_AMBER, points=points, kind="points")


def _name(sensor: RangeSensor | SonarSensor) -> str:
    return f"{sensor.model.name}::{sensor.parent_name}::{sensor.sensor.name}"


def _place(sensor: RangeSensor | SonarSensor, snapshot: Snapshot) -> Pose:
    if isinstance(sensor, SonarSensor):
        return sensor.world_from_link(snapshot) @ sensor.link_from_beam
    return sensor.world_from_sensor(snapshot)
