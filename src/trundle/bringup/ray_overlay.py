"""Lines on the page of sensors with <visualize>: the rays of lidars, the cones of sonars."""

import math
from collections.abc import Callable, Iterable

import numpy as np
from numpy.typing import NDArray

from trundle.page import Line
from trundle.sensors import CameraSensor, InstrumentSensor, RangeReading, RangeSensor, SonarSensor, directions_of
from trundle.simulation import Snapshot
from trundle.spatial import Pose, transform_points

_MAX_RAYS = 90
"""Rays drawn per sensor; of more, every n-th."""
_RIM = 24
_BLUE = (90, 150, 255, 255)


class RayOverlay:
    """Keeper of each sensor's last reading."""

    def __init__(self, shown: Callable[[], bool]) -> None:
        """Prepare; readings are taken only while the page is shown.

        Args:
            shown: True if a browser shows the page.
        """
        self._shown = shown
        self._ends: dict[RangeSensor | SonarSensor, NDArray[np.float64]] = {}
        """Sensor → (rays, 3) end points in its frame [m]; a sonar's are in its beam's frame."""
        self._listened: set[int] = set()

    def set_sensors(self, sensors: Iterable[CameraSensor | InstrumentSensor]) -> None:
        """Set the sensors to draw."""
        seen = [each for each in sensors if isinstance(each, RangeSensor | SonarSensor) and each.sensor.visualize]
        self._ends = {sensor: self._ends.get(sensor, np.zeros((0, 3))) for sensor in seen}
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
        return tuple(_fan(sensor, snapshot, ends) for sensor, ends in self._ends.items() if len(ends))

    def _listen_to_rays(self, sensor: RangeSensor) -> None:
        directions = directions_of(sensor.scan)
        chosen = np.arange(0, len(directions), -(-len(directions) // _MAX_RAYS))

        def keep(reading: RangeReading) -> None:
            ranges = np.clip(reading.ranges.ravel()[chosen], sensor.scan.min_m, sensor.scan.max_m)
            self._ends[sensor] = directions[chosen] * ranges[:, None]

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


def _place(sensor: RangeSensor | SonarSensor, snapshot: Snapshot) -> Pose:
    if isinstance(sensor, SonarSensor):
        return sensor.world_from_link(snapshot) @ sensor.link_from_beam
    return sensor.world_from_sensor(snapshot)


def _fan(sensor: RangeSensor | SonarSensor, snapshot: Snapshot, ends: NDArray[np.float64]) -> Line:
    """A line along each ray."""
    world_from_rays = _place(sensor, snapshot)
    points = np.empty((2 * len(ends), 3), dtype=np.float32)
    points[0::2] = world_from_rays.position
    points[1::2] = transform_points(world_from_rays, ends)
    name = f"{sensor.model.name}::{sensor.parent_name}::{sensor.sensor.name}"
    return Line(id=name, rgba=_BLUE, points=points, kind="pairs")
