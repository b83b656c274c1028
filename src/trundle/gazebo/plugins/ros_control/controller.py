"""Protocol of ros_control's controllers, and their shared parts."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol, Self

from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import Node, Publisher, ReconfigureServer, Service, Subscription
from trundle.sim.control import ServoLaw
from trundle.sim.simulation import ModelHandle

from .hardware import Hardware, JointHardware
from .transmissions import Interface

if TYPE_CHECKING:
    from trundle.ros.message_types import std_msgs


@dataclass(frozen=True, slots=True, kw_only=True)
class ControllerContext:
    """Name, parameters, joints and node of a controller."""

    name: str
    """Global name; its parameters and topics are below it."""
    namespace: str
    """Namespace of the robot."""
    node: Node
    settings: RosParameters
    hardware: Hardware
    model: ModelHandle

    def joint(self, name: str, interface: Interface | None) -> JointHardware:
        """Return a joint with an interface; None: any.

        Raises:
            ParamError: no such joint; the message lists the joints with that interface.
        """
        joint = self.hardware.get(name)
        names = ", ".join(sorted(j.name for j in self.hardware.values() if interface in (None, j.interface)))
        if joint is None or interface not in (None, joint.interface):
            suffix = "" if interface is None else f" with {interface}"
            raise ParamError(f"{self.name}: no joint {name!r}{suffix}; joints: {names or 'none'}")
        return joint

    def joint_setting(self) -> list[str]:
        """Return the joint names in the parameter `joints`, or `joint`.

        Raises:
            ParamError: neither is set.
        """
        names = self.settings.texts("joints") if "joints" in self.settings else [self.settings.text("joint")]
        if not names:
            raise ParamError(f"parameter {self.name}/joints names no joint")
        return names


class Controller(Protocol):
    """Controller, initially stopped; all methods run on the simulation's thread, `update` at every step unless it is an
    `InStepController`.
    """

    claims: dict[Interface | str, list[str]]
    """Interface → joints claimed for this controller alone."""

    @classmethod
    def create(cls, context: ControllerContext) -> Self:
        """Read parameters, advertise and subscribe.

        Raises:
            ParamError: a parameter is missing or invalid.
        """
        ...

    def start(self, time_ns: int) -> None:
        """Start; called just after the joints are read."""
        ...

    def update(self, time_ns: int, dt: float) -> None:
        """Read joints, write commands."""
        ...

    def stop(self) -> None:
        """Stop commanding the joints."""
        ...

    def close(self) -> None:
        """Unregister its topics, services and actions."""
        ...


class InStepController:
    """Base of controllers that are not updated in Python at every step."""

    laws: Sequence[ServoLaw] = ()
    """Laws in C++ that command its joints at every step."""

    def due_ns(self, time_ns: int) -> float:
        """Return the time of the next `update` after an update [ns]."""
        del time_ns
        return math.inf

    def update(self, time_ns: int, dt: float) -> None:
        """Finish the stride and publish due messages; called just after the laws' update."""
        del time_ns, dt
        self.finish_stride()

    def finish_stride(self) -> None:
        """Handle the event, if any, with which a law ended the stride."""


def group_command(message: "std_msgs.Float64MultiArray", count: int, node: Node) -> list[float]:
    """Return the values of a std_msgs/Float64MultiArray for `count` joints; log an error and return [] if invalid."""
    values = [float(value) for value in message.data]
    if len(values) != count:
        node.log.error(
            f"Dimension of command ({len(values)}) does not match number of joints ({count})! Not executing!"
        )
        return []
    return values if all(map(math.isfinite, values)) else []


class Endpoints:
    """Topics and services that a controller unregisters when it closes."""

    def __init__(self) -> None:
        self._endpoints: list[Publisher | Subscription | Service | ReconfigureServer] = []

    def add(self, *endpoints: Publisher | Subscription | Service | ReconfigureServer) -> None:
        """Add endpoints."""
        self._endpoints.extend(endpoints)

    def close(self) -> None:
        """Unregister all."""
        for endpoint in self._endpoints:
            endpoint.unregister()
        self._endpoints.clear()


class PublishTimer:
    """Timer with a rate in simulation time."""

    def __init__(self, rate_hz: float) -> None:
        self._period_ns = round(1e9 / rate_hz)
        self._last_ns = -math.inf

    def restart(self, time_ns: int) -> None:
        """Start a period now."""
        self._last_ns = time_ns

    @property
    def next_ns(self) -> float:
        """End of the current period [ns]."""
        return self._last_ns + self._period_ns

    def skip(self, time_ns: int, dt: float) -> None:
        """Skip the periods that ended before this control period [s], while there was no subscriber."""
        passed_ns = time_ns - round(dt * 1e9) - self._last_ns
        if self._period_ns <= passed_ns < math.inf:
            self._last_ns += passed_ns // self._period_ns * self._period_ns

    def due(self, time_ns: int) -> bool:
        """Return True if a period has passed; then start the next."""
        if time_ns < self._last_ns:  # the simulation was reset
            self._last_ns = time_ns
        if time_ns < self._last_ns + self._period_ns:
            return False
        self._last_ns = max(self._last_ns + self._period_ns, time_ns - self._period_ns)
        return True
