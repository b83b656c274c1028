"""Sonars: range of the nearest surface in a cone."""

import math

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.robots.model import Sonar
from trundle.sim.simulation import Snapshot
from trundle.spatial import Pose, quaternion_from_rpy, rotate_vectors

from .live_sensor import LiveSensor, SensorMount
from .rays import Rays

DEFAULT_RATE_HZ = 40.0
"""Update rate of a sonar whose update_rate is 0."""
_RINGS = 8
_ALL_ROUND = math.pi


class SonarReading(Struct, frozen=True, kw_only=True):
    """Range of the nearest surface."""

    __module__ = "trundle"

    time_ns: int
    range_m: float
    """Range [m] within the sensor's limits; the maximum also means no echo, as in Gazebo."""


class SonarSensor(LiveSensor[SonarReading]):
    """Sonar of 217 rays in a cone; Gazebo intersects a cone mesh with the shapes, with the same result."""

    def __init__(self, mount: SensorMount, *, rays: Rays) -> None:
        """Mount a sonar; see `LiveSensor`.

        Args:
            mount: model, link and sensor.
            rays: casts the rays.
        """
        super().__init__(mount, default_rate_hz=DEFAULT_RATE_HZ)
        assert isinstance(mount.sensor.instrument, Sonar), f"{mount.sensor.name!r} is no sonar"
        self.settings = mount.sensor.instrument
        is_cone = self.settings.geometry == "cone"
        half = math.atan2(self.settings.radius, self.settings.max_m) if is_cone else _ALL_ROUND
        self.fov_rad = 2.0 * half
        self.link_from_beam = mount.sensor.link_from_sensor @ Pose(
            quaternion=quaternion_from_rpy(0.0, math.pi / 2, 0.0)
        )
        """Beam frame, whose x axis is −z of the sensor's frame."""
        self._directions = _cone(half)
        self._reach = self.settings.max_m / self._directions[:, 0] if is_cone else np.inf
        """Length of the cone along each ray [m]."""
        self._farthest = math.hypot(self.settings.max_m, self.settings.radius) if is_cone else self.settings.radius
        self._rays = rays

    def measure(self, snapshot: Snapshot) -> SonarReading:
        """Measure the range."""
        beam = self.world_from_link(snapshot) @ self.link_from_beam
        directions = rotate_vectors(beam, self._directions)
        distances = self._rays(beam.position, directions, self._farthest, self.link_index).distances
        nearest = float(np.min(np.where(distances <= self._reach, distances, np.inf)))
        low, high = self.settings.min_m, self.settings.max_m
        return SonarReading(time_ns=snapshot.time_ns, range_m=min(max(nearest, low), high))


def _cone(half_rad: float) -> NDArray[np.float64]:
    """Return (rays, 3) unit vectors around +x: the axis, and rings of 6, 12, 18, … rays."""
    rays = [(1.0, 0.0, 0.0)]
    for ring in range(1, _RINGS + 1):
        angle = half_rad * ring / _RINGS
        for i in range(6 * ring):
            turn = math.tau * i / (6 * ring)
            rays.append((math.cos(angle), math.sin(angle) * math.cos(turn), math.sin(angle) * math.sin(turn)))
    return np.array(rays)
