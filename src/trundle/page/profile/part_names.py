"""Names and groups of the parts of a profile."""

from enum import Enum

from trundle.sim.simulation import Simulation, StridePart

from ..world.profile import Group


class LoopPart(Enum):
    """Parts of a run outside of its strides."""

    PAGE = "page"
    PUBLISHING = "publishing"
    """Encoding and sending messages of plugins."""
    DELIVERY = "delivery"
    """Setting the nodes' time after the strides and, at full speed, waiting for their callbacks."""


_NAMES: dict[object, tuple[Group, str]] = {
    StridePart.BETWEEN: ("waiting", "Waiting"),
    StridePart.COMMANDS: ("ros", "Callbacks of messages"),
    StridePart.SCHEDULE: ("other", "Schedule and snapshots"),
    StridePart.LISTENERS: ("ros", "Readings sent"),
    StridePart.TIMELINE: ("other", "States of the timeline"),
    LoopPart.PAGE: ("page", "Page"),
    LoopPart.PUBLISHING: ("ros", "Messages of plugins"),
    LoopPart.DELIVERY: ("ros", "Deliveries to nodes"),
}
_BASES: dict[str, Group] = {
    "trundle.sim.sensors.cameras.camera.CameraSensor": "cameras",
    "trundle.sim.sensors.live_sensor.LiveSensor": "sensors",
    "trundle.gazebo.plugins.plugin.Hooks": "plugins",
}
"""Base class → group; classes by name, so that a simulation without plugins does not load their module."""


def group_and_name(part: object, simulation: Simulation) -> tuple[Group, str]:
    """Return the group and the name of a hook, a `StridePart` or a `LoopPart`."""
    if isinstance(part, StridePart | LoopPart):
        return _NAMES[part]
    return _group_of(type(part)), simulation.hook_name(part) or type(part).__name__


def _group_of(kind: type) -> Group:
    for base in kind.__mro__:
        if (group := _BASES.get(f"{base.__module__}.{base.__qualname__}")) is not None:
            return group
    return "ros" if kind.__module__.startswith(("trundle.ros.bridge.", "trundle.gazebo.nodes.")) else "other"
