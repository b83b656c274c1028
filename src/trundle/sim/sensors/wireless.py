"""Wireless receivers and RFID readers."""

import math
from collections.abc import Callable, Sequence

import numpy as np
from msgspec import Struct

from trundle.robots.model import Transceiver
from trundle.sim.simulation import Snapshot
from trundle.spatial import Pose, Vector3, normalized

from .live_sensor import LiveSensor, SensorMount
from .rays import Rays

DEFAULT_RATE_HZ = 10.0
"""Update rate of a receiver whose update_rate is 0."""
_LIGHT = 299_792_458.0
"""Speed of light [m/s]."""
_FREE, _OBSTRUCTED = 6.0, 12.0
"""Gazebo's path loss exponents."""
_SHADOWING = 6.0
"""Standard deviation of Gazebo's random shadowing loss [dB]."""
_NEAREST = 1.0
"""Lower bound of the distance [m]."""
_TAG_REACH = 5.0
"""Gazebo's RFID range [m]."""


class Transmitter(Struct, frozen=True, kw_only=True):
    """Transmitter or RFID tag on a link."""

    name: str
    link_index: int
    link_from_transmitter: Pose
    settings: Transceiver

    def position(self, snapshot: Snapshot) -> Vector3:
        """Return the position in the world [m]."""
        x, y, z, qw, qx, qy, qz = snapshot.poses[self.link_index].tolist()
        return Pose((x, y, z), (qw, qx, qy, qz)).transform_point(self.link_from_transmitter.position)


class ReceivedSignal(Struct, frozen=True, kw_only=True):
    """Signal of a transmitter in range."""

    name: str
    """ESSID of the transmitter."""
    frequency_mhz: float
    level_dbm: float


class WirelessReading(Struct, frozen=True, kw_only=True):
    """Signals received."""

    __module__ = "trundle"

    time_ns: int
    signals: tuple[ReceivedSignal, ...]


class WirelessSensor(LiveSensor[WirelessReading]):
    """Wireless receiver with Gazebo's Hata-Okumura model: obstacles attenuate."""

    def __init__(self, mount: SensorMount, *, transmitters: Callable[[], Sequence[Transmitter]], rays: Rays) -> None:
        """Mount a receiver; see `LiveSensor`.

        Args:
            mount: model, link and sensor.
            transmitters: returns all transmitters.
            rays: casts rays to find obstacles.
        """
        super().__init__(mount, default_rate_hz=DEFAULT_RATE_HZ)
        assert isinstance(mount.sensor.instrument, Transceiver), f"{mount.sensor.name!r} is no receiver"
        self._settings = mount.sensor.instrument
        self._transmitters = transmitters
        self._rays = rays
        self._random = mount.random

    def measure(self, snapshot: Snapshot) -> WirelessReading:
        """Return the signals above the sensitivity."""
        settings = self._settings
        signals: list[ReceivedSignal] = []
        for transmitter in self._transmitters():
            sender = transmitter.settings
            if not settings.lowest_mhz <= sender.frequency_mhz <= settings.highest_mhz:
                continue
            level = self._level(transmitter, snapshot)
            if level >= settings.sensitivity_dbm:
                signals.append(ReceivedSignal(name=sender.essid, frequency_mhz=sender.frequency_mhz, level_dbm=level))
        return WirelessReading(time_ns=snapshot.time_ns, signals=tuple(signals))

    def _level(self, transmitter: Transmitter, snapshot: Snapshot) -> float:
        receiver, sender = self.world_from_sensor(snapshot).position, transmitter.position(snapshot)
        settings = transmitter.settings
        exponent = _OBSTRUCTED if self._is_obstructed(receiver, sender, transmitter.link_index) else _FREE
        shadowing = abs(float(self._random.normal(0.0, _SHADOWING)))
        wave = 20.0 * math.log10(_LIGHT / (settings.frequency_mhz * 1e6) / (4.0 * math.pi))
        path_loss = 10.0 * exponent * math.log10(max(_NEAREST, math.dist(receiver, sender)))
        return settings.power_dbm + settings.gain_dbi + self._settings.gain_dbi - shadowing + wave - path_loss

    def _is_obstructed(self, start: Vector3, end: Vector3, exclude: int) -> bool:
        """True if a third link is in between: rays from the two ends stop before they meet."""
        direction = normalized((end[0] - start[0], end[1] - start[1], end[2] - start[2]))
        if direction is None:
            return False
        distance = math.dist(start, end)
        forward = self._rays(start, np.array([direction]), distance, self.link_index).distances[0]
        backward = self._rays(end, -np.array([direction]), distance, exclude).distances[0]
        return bool(forward + backward <= distance)


class RfidReading(Struct, frozen=True, kw_only=True):
    """RFID tags in range."""

    __module__ = "trundle"

    time_ns: int
    tags: tuple[str, ...]
    """`model::link::sensor`"""


class RfidSensor(LiveSensor[RfidReading]):
    """RFID reader: lists tags within five metres, regardless of obstacles, as Gazebo does."""

    def __init__(self, mount: SensorMount, *, tags: Callable[[], Sequence[Transmitter]]) -> None:
        """Mount a reader; see `LiveSensor`.

        Args:
            mount: model, link and sensor.
            tags: returns all tags.
        """
        super().__init__(mount, default_rate_hz=DEFAULT_RATE_HZ)
        self._tags = tags

    def measure(self, snapshot: Snapshot) -> RfidReading:
        """List the tags in range."""
        position = self.world_from_sensor(snapshot).position
        near = [tag.name for tag in self._tags() if math.dist(position, tag.position(snapshot)) <= _TAG_REACH]
        return RfidReading(time_ns=snapshot.time_ns, tags=tuple(near))
