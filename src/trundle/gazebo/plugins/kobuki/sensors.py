"""Kobuki's bumpers, cliff and wheel drop sensors: events, and `sensors/core`."""

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any

from trundle.robots.model import Model, Sensor
from trundle.robots.parameters import TagParameters
from trundle.ros import Message
from trundle.ros.bridge import sensor_topic
from trundle.sim.simulation import ModelHandle

from ..gazebo_ros.plugin_names import PluginNames, TopicPublisher

_SIDES = ("left", "center", "right")
_BITS = {"left": 4, "center": 2, "right": 1}
"""Bits of `bumper` and `cliff` in kobuki_msgs/SensorState."""
_DROP_BITS = {"left": 2, "right": 1}
_BUMPER_M = (0.01, 0.13)
"""Height range of the bumper above the model's origin [m] (updateBumper of the original)."""
_STAMP_MOD_MS = 1 << 16


@dataclass(frozen=True, slots=True)
class ModelSensor:
    """Sensor of the model, read on its topic."""

    model: Model
    link: str
    sensor: Sensor

    def topic(self, output: str) -> str:
        """Topic of its output: contacts, imu, scan."""
        return sensor_topic(self.model, self.link, self.sensor, output, main=output)


class _EventPublisher:
    """Switches of one kind; each change is published as an event."""

    def __init__(self, publisher: TopicPublisher, field: str, order: Iterable[str]) -> None:
        self._publisher = publisher
        self._field = field
        self._order = list(order)
        self.on: set[str] = set()

    def set(self, side: str, *, on: bool, **fields: int) -> None:
        """Set one switch."""
        if on == (side in self.on):
            return
        self.on = self.on | {side} if on else self.on - {side}
        if self._publisher.has_subscribers:
            self._publisher.publish({self._field: self._order.index(side), "state": int(on), **fields})


class KobukiSensors:
    """Reads the model's contact and ray sensors on their topics.

    Parameters: <bumper_name> (a contact sensor), <cliff_sensor_left_name>, <cliff_sensor_center_name>,
    <cliff_sensor_right_name> (ray sensors) and <cliff_detection_threshold> [m], all required; without
    <wheel_drop_left_sensor_name> and <wheel_drop_right_sensor_name>, as in old files, there is no wheel drop.
    """

    def __init__(
        self,
        model: ModelHandle,
        names: PluginNames,
        base: str,
        parameters: TagParameters,
        sensor: Callable[[str], ModelSensor],
    ) -> None:
        """Subscribe.

        Args:
            model: model of the sensors.
            names: plugin's names.
            base: prefix of the topics, in the plugin's namespace.
            parameters: plugin's parameters.
            sensor: function that returns the sensor in a parameter.
        """
        self._model = model
        self._cliff_m = parameters.number("cliff_detection_threshold", 0.0)

        def switches(name: str, kind: str, field: str, order: Iterable[str]) -> _EventPublisher:
            publisher = names.advertise(f"kobuki_msgs/{kind}Event", f"{base}/events/{name}", queue_size=10)
            return _EventPublisher(publisher, field, order)

        self._bumpers = switches("bumper", "Bumper", "bumper", _SIDES)
        self._cliffs = switches("cliff", "Cliff", "sensor", _SIDES)
        self._drops = switches("wheel_drop", "WheelDrop", "wheel", _DROP_BITS)
        self._core = names.advertise("kobuki_msgs/SensorState", f"{base}/sensors/core")
        self._frame = names.frame("base_link")

        def listen(parameter: str, output: str, kind: str, callback: Callable[[Message], None]) -> None:
            names.node.subscribe(sensor(parameter).topic(output), kind, callback, queue_size=1)

        contacts, scan = ("contacts", "gazebo_msgs/ContactsState"), ("scan", "sensor_msgs/LaserScan")
        listen("bumper_name", *contacts, self._on_bumper)
        for side in _DROP_BITS:
            if f"wheel_drop_{side}_sensor_name" not in parameters:
                continue
            listen(
                f"wheel_drop_{side}_sensor_name",
                *contacts,
                lambda message, side=side: self._on_wheel_drop(side, message),
            )
        for side in _SIDES:
            listen(f"cliff_sensor_{side}_name", *scan, lambda message, side=side: self._on_cliff(side, message))

    def reset(self) -> None:
        """Switch all off."""
        for switches in (self._bumpers, self._cliffs, self._drops):
            switches.on = set()

    def publish(self, time_ns: int) -> None:
        """Publish the current state."""
        if not self._core.has_subscribers:
            return
        state: dict[str, Any] = {
            "header": {"stamp": time_ns, "frame_id": self._frame},
            "time_stamp": time_ns // 1_000_000 % _STAMP_MOD_MS,
            "bumper": sum(_BITS[side] for side in self._bumpers.on),
            "cliff": sum(_BITS[side] for side in self._cliffs.on),
            "wheel_drop": sum(_DROP_BITS[side] for side in self._drops.on),
        }
        self._core.publish(state)

    def _on_bumper(self, message: Message) -> None:
        """Update the bumpers: each covers 60° of the front."""
        height, yaw = self._model.pose.position[2], self._model.pose.rpy[2]
        pressed: set[str] = set()
        for state in message.states:
            for position, normal in zip(state.contact_positions, state.contact_normals, strict=True):
                if not _BUMPER_M[0] <= position.z - height <= _BUMPER_M[1]:
                    continue
                bearing = math.remainder(math.atan2(-normal.y, -normal.x) - yaw, math.tau)  # normals point inwards
                if abs(bearing) <= math.pi / 6:
                    pressed.add("center")
                elif abs(bearing) <= math.pi / 2:
                    pressed.add("left" if bearing > 0.0 else "right")
        for side in _SIDES:
            self._bumpers.set(side, on=side in pressed)

    def _on_wheel_drop(self, side: str, message: Message) -> None:
        """Update a wheel drop sensor: a wheel without contacts has dropped."""
        self._drops.set(side, on=not message.states)

    def _on_cliff(self, side: str, scan: Message) -> None:
        """Update a cliff sensor by the scan's first ray; no hit counts as the largest range."""
        range_m = float(scan.ranges[0])
        distance = range_m if math.isfinite(range_m) else float(scan.range_max)
        # The real sensor's 16-bit reading at that distance (updateCliffSensor of the original).
        raw = int(76123.0 * math.atan2(0.995, distance)) & 0xFFFF
        self._cliffs.set(side, on=distance >= self._cliff_m, bottom=raw)
