"""robot_controllers/ParallelGripperController: two fingers."""

from trundle.ros import ActionServer
from trundle.sim.control import GripperLaw, ToolboxPid

from ..ros_control import ControllerContext, FingersController
from .trajectory import RequestStart

_P, _D = 1000.0, 20.0
"""[N/m] and [N·s/m], of each finger."""
_TOLERANCE, _STALL_NS, _STALL_SPEED = 0.002, 2_000_000_000, 0.00125
"""Tolerance of the fingers' distance [m]. A finger that is slower than this [m/s] for this time [ns] stalls."""


class ParallelGripper(FingersController):
    """Action `<name>` (control_msgs/GripperCommand): distance of the fingers, and the effort with which they close.

    Parameters: l_gripper_joint and r_gripper_joint (l_ and r_gripper_finger_joint), max_position 0.1 [m],
    max_effort 10 [N]. A gripper that stalls has succeeded, with an object in it.
    """

    stalled_status = "succeeded"

    def __init__(self, context: ControllerContext, request_start: RequestStart) -> None:
        settings = context.settings
        names = (settings.text(f"{side}_gripper_joint", f"{side}_gripper_finger_joint") for side in "lr")
        fingers = [context.joint(name, "EffortJointInterface") for name in names]
        self._max_position = settings.number("max_position", 0.1)
        self._max_effort = settings.number("max_effort", 10.0)
        self._request_start = request_start
        laws = [
            GripperLaw(
                finger,
                ToolboxPid(p=_P, i=0.0, d=_D, i_clamp=0.0, antiwindup=False),
                tolerance=_TOLERANCE / 2,
                min_speed=_STALL_SPEED,
                stall_ns=_STALL_NS,
            )
            for finger in fingers
        ]
        super().__init__(context.node, fingers, laws)
        self._server = ActionServer(
            context.node, context.name, "control_msgs/GripperCommand", self._on_goal, concurrent=True
        )

    def prepare(self) -> bool:
        """Start the controller."""
        self._request_start()
        return True

    def limit(self, position: float, max_effort: float) -> tuple[float, float]:
        """Return the values within their bounds; an effort of 0 is the largest."""
        effort = max_effort if 0.0 < max_effort <= self._max_effort else self._max_effort
        return min(max(position, 0.0), self._max_position), effort
