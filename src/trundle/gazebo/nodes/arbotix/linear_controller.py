"""arbotix_python's linear joints and controllers, simulated: joints jump to their commands."""

from typing import TYPE_CHECKING

from trundle.robots.parameters import RosParameters
from trundle.ros import Node

from .controller import DiagnosticStatus, JointReading

if TYPE_CHECKING:
    from trundle.ros.message_types import std_msgs, std_srvs


class LinearJoint:
    """A joint that jumps to its command; like the original's simulation, without limits."""

    def __init__(self, node: Node, name: str, settings: RosParameters) -> None:
        for limit, default in (("min_position", 0.0), ("max_position", 0.5), ("max_speed", 0.0508)):
            settings.number(limit, default)
        self.reading = JointReading(name=name)
        node.subscribe(f"{name}/command", "std_msgs/Float64", self._command)

    def _command(self, message: "std_msgs.Float64") -> None:
        self.reading.position = float(message.data)

    def interpolate(self, rate_hz: float) -> None:
        """No-op."""

    def status(self) -> DiagnosticStatus:
        """Name, OK and the position."""
        return DiagnosticStatus(name=self.reading.name, values=(("Position", str(self.reading.position)),))


class LinearController:
    """linear_controller and linear_controller_i; the latter can be zeroed."""

    def __init__(self, node: Node, name: str, settings: RosParameters, *, incremental: bool = False) -> None:
        """Create from `~controllers/<name>`.

        Raises:
            ParamError: no joint, or an invalid parameter.
        """
        settings.text("joint")
        settings.number("rate", 10.0, above=0.0)
        self.readings: list[JointReading] = []
        self._name = name
        if incremental:
            node.advertise_service(f"{name}/zero", "std_srvs/Empty", self._zero)
        node.log.info(f"Started LinearController{'Incremental' if incremental else ''} ({name}).")

    def _zero(self, _request: "std_srvs.EmptyRequest") -> dict[str, object]:
        return {}

    def update(self) -> None:
        """No-op."""

    def status(self) -> DiagnosticStatus:
        """Name and OK."""
        return DiagnosticStatus(name=self._name)
