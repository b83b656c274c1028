"""libKeysToCmdVelPlugin.so: velocity commands from keys."""

import math
from typing import Self

from trundle.robots.model import PluginTag
from trundle.robots.names import ros_name
from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import ModelHandle, Simulation

from ..plugin import Plugin
from .key_topic import subscribe_keys

_KEYS = {
    "stop": (13, 32),
    "accelerate": (38, 16777235),
    "decelerate": (40, 16777237),
    "left": (37, 16777234),
    "right": (39, 16777236),
}
"""Key codes: return and space; the arrows of browsers and of Qt."""


class KeysToCmdVel(Plugin):
    """Turns keys into geometry_msgs/Pose on <cmd_vel_topic> (~/cmd_vel, with / for ~ here): x is speed, yaw the rate.

    Further parameters: <max_linear_vel> 1, <min_linear_vel> −max [m/s], <linear_increment> 0.5 [m/s] per press,
    <max_angular_vel> 1, <angular_increment> 0.5 [rad/s], <key_controls> with any number of <stop>, <accelerate>,
    <decelerate>, <left> and <right>: key codes. As in Gazebo, left is negative yaw.
    """

    def __init__(self, node: Node | None, tag: PluginTag, sim: Simulation) -> None:
        parameters = TagParameters(tag.node, sim.report)

        topic = parameters.text("cmd_vel_topic", "~/cmd_vel")
        self._max_speed = parameters.number("max_linear_vel", 1.0)
        self._min_speed = parameters.number("min_linear_vel", -self._max_speed)
        self._linear_step = parameters.number("linear_increment", 0.5)
        self._max_yaw_rate = parameters.number("max_angular_vel", 1.0)
        self._angular_step = parameters.number("angular_increment", 0.5)
        self._keys = {key: action for action, keys in _KEYS.items() for key in keys}
        controls = parameters.section("key_controls")
        if any(action in controls for action in _KEYS):
            self._keys = dict[int, str]()
            for action in _KEYS:
                self._keys.update(dict.fromkeys(_read_keys(controls, action), action))
        parameters.report_unread()
        self.speed = self.yaw_rate = 0.0
        self._topic = None
        if node is not None:
            name = ros_name(topic.removeprefix("~").strip("/"))
            self._topic = node.advertise(f"/{name}", "geometry_msgs/Pose", queue_size=10)

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """See `Plugin.load`."""
        del model
        plugin = cls(node, tag, sim)
        subscribe_keys(node, tag, plugin.on_key, sim.report)
        return plugin

    def on_key(self, key: int) -> None:
        """Handle a key."""
        match self._keys.get(key):
            case "stop":
                self.speed = self.yaw_rate = 0.0
            case "accelerate":
                self.speed = self._clamp(self.speed + self._linear_step)
            case "decelerate":
                self.speed = self._clamp(self.speed - self._linear_step)
            case "left":
                self.yaw_rate = max(self.yaw_rate - self._angular_step, -self._max_yaw_rate)
            case "right":
                self.yaw_rate = min(self.yaw_rate + self._angular_step, self._max_yaw_rate)
            case _:
                return
        if self._topic is not None:
            half = self.yaw_rate / 2
            turn = {"x": 0.0, "y": 0.0, "z": math.sin(half), "w": math.cos(half)}
            self._topic.publish({"position": {"x": self.speed}, "orientation": turn})

    def reset(self) -> None:
        """Set both speeds to zero."""
        self.speed = self.yaw_rate = 0.0

    def _clamp(self, speed: float) -> float:
        return min(max(speed, self._min_speed), self._max_speed)


def _read_keys(controls: TagParameters, action: str) -> list[int]:
    """Return the key codes of an action."""
    keys = controls.texts(action)
    for key in keys:
        if not key.isdecimal():
            controls.warn(f"<{action}>: {key!r} is not a key code; it is left out", action)
    if not keys:
        controls.warn(f"<key_controls> has no <{action}>; no key is bound to it")
    return [int(key) for key in keys if key.isdecimal()]
