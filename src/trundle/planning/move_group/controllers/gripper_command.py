"""Grippers with the action control_msgs/GripperCommand."""

from collections.abc import Sequence

import numpy as np

from trundle.ros import Node

from .action_call import ActionCall
from .follow_joint_trajectory import PREEMPTED, SUCCEEDED
from .joint_path import JointPath
from .outcome import Outcome

_WAIT_S = 15.0
_ABORTED = 4


class GripperCommand:
    """Sends the last point of a trajectory as one position."""

    def __init__(
        self,
        node: Node,
        name: str,
        action: str,
        joints: Sequence[str],
        *,
        command_joints: Sequence[str] = (),
        max_effort: float = 0.0,
        allow_failure: bool = False,
        is_parallel: bool = False,
        is_default: bool = False,
        is_active: bool = True,
    ) -> None:
        """Make a controller.

        Args:
            node: node of the client.
            name: name of the controller.
            action: action's namespace.
            joints: joints that it moves.
            command_joints: joint whose position is the command; two of a parallel gripper, whose sum is; default: the
                first of the trajectory's.
            max_effort: greatest effort [N] or [N·m]; 0: the gripper's.
            allow_failure: True: a gripper that stalls, as on an object, has succeeded.
            is_parallel: True: the command is the sum of two joints.
            is_default: True: preferred.
            is_active: True if it takes commands now.
        """
        self.name = name
        self.joints = tuple(joints)
        self.is_default = is_default
        self.is_active = is_active
        self._node = node
        self._command_joints = tuple(command_joints)
        self._max_effort = max_effort
        self._allows_failure = allow_failure
        self._is_parallel = is_parallel
        self._call = ActionCall(node, action, "control_msgs/GripperCommand")

    async def execute(self, path: JointPath) -> Outcome:
        """Send the last positions, and await the gripper."""
        if len(path.times_s) == 0 or not path.joints:
            self._node.log.error(f"{self.name}: GripperController requires at least one joint trajectory point")
            return Outcome.ABORTED
        if not await self._call.wait_for_server(_WAIT_S):
            return Outcome.ABORTED
        last = dict(zip(path.joints, path.positions[-1], strict=True))
        wanted = [name for name in self._command_joints if name in last] or list(path.joints[:1])
        position = sum(float(last[name]) for name in (wanted if self._is_parallel else wanted[:1]))
        effort = self._max_effort
        state, result = await self._call.run({"command": {"position": position, "max_effort": effort}})
        if state == SUCCEEDED:
            return Outcome.SUCCEEDED
        is_held = result is not None and bool(result.stalled)
        if state == _ABORTED and (self._allows_failure or is_held):
            found = np.nan if result is None else float(result.position)
            self._node.log.info(f"{self.name} stopped at {found:g} on its way to {position:g}")
            return Outcome.SUCCEEDED
        self._node.log.warn(f"{self.name} did not reach {position:g}")
        return Outcome.PREEMPTED if state == PREEMPTED else Outcome.ABORTED
