"""Ray sensors and lidars."""

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.robots.model import RangeScan, ScanAxis
from trundle.sim.simulation import Snapshot
from trundle.spatial import Pose, rotate_vectors

from .live_sensor import LiveSensor, SensorMount
from .noise import NoiseSource
from .rays import Rays

DEFAULT_RATE_HZ = 40.0
"""Update rate of a sensor whose update_rate is 0."""


class RangeReading(Struct, frozen=True, eq=False, kw_only=True):
    """Ranges and intensities of a scan."""

    __module__ = "trundle"

    time_ns: int
    scan: RangeScan
    ranges: NDArray[np.float64]
    """(vertical values, horizontal values) [m]; inf beyond the maximum range, −inf below the minimum."""
    intensities: NDArray[np.float64]
    """(vertical values, horizontal values) laser_retro of the surface hit; 0 without a hit."""

    @property
    def horizontal_angles(self) -> NDArray[np.float64]:
        """Angle of each column of `ranges` (horizontal values,) about the sensor's z axis [rad]; 0 is its x axis."""
        return angles_of(self.scan.horizontal)

    @property
    def vertical_angles(self) -> NDArray[np.float64]:
        """Angle of each row of `ranges` (vertical values,) above the sensor's x-y plane [rad]."""
        return angles_of(self.scan.vertical)


class RangeSensor(LiveSensor[RangeReading]):
    """Ray sensor: casts against collision shapes of other links; a GPU sensor, as in Gazebo, against all visuals."""

    def __init__(self, mount: SensorMount, *, rays: Rays) -> None:
        """Mount a ray sensor; see `LiveSensor`.

        Args:
            mount: model, link and sensor.
            rays: casts the rays.
        """
        super().__init__(mount, default_rate_hz=DEFAULT_RATE_HZ)
        assert mount.sensor.scan is not None, f"{mount.sensor.name!r} has no scan"
        self.scan = mount.sensor.scan
        self._rays = rays
        self._noise = NoiseSource(mount.sensor.scan.noise, mount.random)
        self._directions = directions_of(mount.sensor.scan)

    def measure(self, snapshot: Snapshot) -> RangeReading:
        """Cast the scan from the sensor's pose."""
        world_from_link = self.world_from_link(snapshot) if self._handle is None else self._handle.pose
        return self.measure_from(world_from_link, snapshot.time_ns, self._noise)

    def measure_from(self, world_from_link: Pose, time_ns: int, noise: NoiseSource) -> RangeReading:
        """Cast the scan in the simulation's current state.

        Args:
            world_from_link: pose of the carrying link.
            time_ns: simulation time.
            noise: noise in place of the sensor's own.
        """
        scan = self.scan
        pose = world_from_link @ self.sensor.link_from_sensor
        hits = self._rays(pose.position, rotate_vectors(pose, self._directions), scan.max_m, self.link_index)
        ranges, retros = hits.distances, hits.retros
        far, near = ranges >= scan.max_m, ranges <= scan.min_m
        missed = far | near
        if not noise.is_silent:
            is_hit = ~missed
            noisy = noise.apply(ranges[is_hit], time_ns)
            ranges[is_hit] = np.minimum(np.maximum(noisy, scan.min_m), scan.max_m)  # np.clip takes twice as long
        ranges[far], ranges[near], retros[missed] = np.inf, -np.inf, 0.0
        shape = (scan.vertical.values, scan.horizontal.values)
        return RangeReading(time_ns=time_ns, scan=scan, ranges=ranges.reshape(shape), intensities=retros.reshape(shape))


def directions_of(scan: RangeScan) -> NDArray[np.float64]:
    """Return (vertical · horizontal, 3) unit vectors in the sensor's frame, row by row from the lowest."""
    yaw, pitch = np.meshgrid(angles_of(scan.horizontal), angles_of(scan.vertical))
    flat = np.cos(pitch)
    return np.stack([flat * np.cos(yaw), flat * np.sin(yaw), np.sin(pitch)], axis=-1).reshape(-1, 3)


def angles_of(axis: ScanAxis) -> NDArray[np.float64]:
    """Return (values,) angles [rad], both ends included; a single ray uses the minimum angle."""
    return np.linspace(axis.min_angle, axis.max_angle, axis.values)
