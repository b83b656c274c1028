"""amcl's diagnostics: a warning while the particles are spread too far."""

import math

from trundle.robots.parameters import RosParameters
from trundle.ros import Node
from trundle.spatial import NS_PER_S

_OK, _WARN = 0, 1


class SpreadWarning:
    """Publishes the standard deviations on /diagnostics, at most once a second.

    Parameters: std_warn_level_x, std_warn_level_y 0.2 [m], std_warn_level_yaw 0.1 [rad].
    """

    def __init__(self, node: Node, parameters: RosParameters) -> None:
        self._node = node
        self._levels = {
            axis: parameters.number(f"std_warn_level_{axis}", default)
            for axis, default in (("x", 0.2), ("y", 0.2), ("yaw", 0.1))
        }
        self._topic = node.advertise("/diagnostics", "diagnostic_msgs/DiagnosticArray", queue_size=1)
        self._last_ns: int | None = None

    def publish(self, variances: tuple[float, float, float]) -> None:
        """Publish the deviations of x, y, yaw with these variances [m², rad²]."""
        now_ns = self._node.clock.now_ns()
        if self._last_ns is not None and 0 <= now_ns - self._last_ns < NS_PER_S:
            return
        self._last_ns = now_ns
        deviations = [math.sqrt(max(variance, 0.0)) for variance in variances]
        excess = [
            axis for axis, deviation in zip(self._levels, deviations, strict=True) if deviation > self._levels[axis]
        ]
        values = [
            pair
            for axis, deviation in zip(self._levels, deviations, strict=True)
            for pair in (
                {"key": f"std_{axis}", "value": f"{deviation:.6f}"},
                {"key": f"std_warn_level_{axis}", "value": f"{self._levels[axis]:.6f}"},
            )
        ]
        status = {
            "level": _WARN if excess else _OK,
            "name": f"{self._node.name.lstrip('/')}: Standard deviation",
            "message": f"Too large: {', '.join(excess)}" if excess else "OK",
            "hardware_id": "None",
            "values": values,
        }
        self._topic.publish({"header": {"stamp": now_ns}, "status": [status]})
