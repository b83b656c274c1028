"""What a controller of ros_control is."""

import math
from dataclasses import dataclass
from typing import Protocol, Self

from trundle.ros import Message, Node, NodeParams, ParamError, Publisher, ReconfigureServer, Service, Subscription
from trundle.simulation import ModelHandle

from .hardware import Hardware, JointHardware
from .transmissions import Interface


@dataclass(frozen=True, slots=True, kw_only=True)
class ControllerContext:
    """Where a controller works."""

    name: str
    """Its name, global; its parameters and topics are within."""
    namespace: str
    """Of the robot."""
    node: Node
    settings: NodeParams
    hardware: Hardware
    model: ModelHandle

    def joint(self, name: str, interface: Interface | None) -> JointHardware:
        """A joint with the interface that a controller needs; None: any.

        Raises:
            ParamError: there is none, with those there are.
        """
        found = self.hardware.get(name)
        there = ", ".join(sorted(j.name for j in self.hardware.values() if interface in (None, j.interface)))
        if found is None or interface not in (None, found.interface):
            wanted = "" if interface is None else f" with {interface}"
            raise ParamError(f"{self.name}: no joint {name!r}{wanted}; there are: {there or 'none'}")
        return found

    def joint_setting(self) -> list[str]:
        """What `joint` or `joints` names.

        Raises:
            ParamError: neither is set.
        """
        names = self.settings.texts("joints") if "joints" in self.settings.names() else [self.settings.text("joint")]
        if not names:
            raise ParamError(f"parameter {self.name}/joints names no joint")
        return names


class Controller(Protocol):
    """Made stopped; all is called on the simulation's thread."""

    claims: dict[Interface | str, list[str]]
    """Interface → joints that nobody else may command."""

    @classmethod
    def create(cls, context: ControllerContext) -> Self:
        """Read parameters, advertise and subscribe.

        Raises:
            ParamError: a parameter is missing or of no use.
        """
        ...

    def start(self, time_ns: int) -> None:
        """Begin; the joints were read just now."""
        ...

    def update(self, time_ns: int, dt: float) -> None:
        """Read joints, write commands."""
        ...

    def stop(self) -> None:
        """Let go."""
        ...

    def close(self) -> None:
        """Leave the graph."""
        ...


def group_command(message: Message, count: int, node: Node) -> list[float]:
    """A std_msgs/Float64MultiArray for so many joints; empty where it is of no use, which is said."""
    values = [float(value) for value in message.data]
    if len(values) != count:
        node.log.error(
            f"Dimension of command ({len(values)}) does not match number of joints ({count})! Not executing!"
        )
        return []
    return values if all(map(math.isfinite, values)) else []


class Endpoints:
    """What a controller has on the graph, to be taken off again."""

    def __init__(self) -> None:
        self._endpoints: list[Publisher | Subscription | Service | ReconfigureServer] = []

    def add(self, *ends: Publisher | Subscription | Service | ReconfigureServer) -> None:
        """Remember."""
        self._endpoints.extend(ends)

    def close(self) -> None:
        """Unregister all."""
        for end in self._endpoints:
            end.unregister()
        self._endpoints.clear()


class PublishTimer:
    """Says when something is due that happens at a rate of simulated time."""

    def __init__(self, rate_hz: float) -> None:
        self._period_ns = round(1e9 / rate_hz)
        self._last_ns = -math.inf

    def restart(self, time_ns: int) -> None:
        """Count from now."""
        self._last_ns = time_ns

    def due(self, time_ns: int) -> bool:
        """Whether a period has passed; if so, the next begins."""
        if time_ns < self._last_ns:  # time was turned back
            self._last_ns = time_ns
        if time_ns < self._last_ns + self._period_ns:
            return False
        self._last_ns = max(self._last_ns + self._period_ns, time_ns - self._period_ns)
        return True
