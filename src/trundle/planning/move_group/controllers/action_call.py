"""One goal of an action, awaited; cancelling the call cancels the goal."""

import asyncio
from typing import TYPE_CHECKING, Any

from trundle.ros import ActionClient, Node

if TYPE_CHECKING:
    from trundle.ros import Message

_POLL_S = 0.02
_WARN_S = 5.0


class ActionCall:
    """A client that runs one goal at a time."""

    def __init__(self, node: Node, name: str, type_name: str) -> None:
        """Connect to an action.

        Args:
            node: node of the client.
            name: action's namespace.
            type_name: action type, such as 'control_msgs/FollowJointTrajectory'.
        """
        self._node = node
        self.name = node.resolve(name)
        self._client = ActionClient(node, name, type_name)

    async def wait_for_server(self, wait_s: float) -> bool:
        """Wait for the server; False if it is not there after `wait_s` of ROS time."""
        clock = self._node.clock
        start_ns = clock.now_ns()
        warned = False
        while not self._client.has_server:
            waited_s = (clock.now_ns() - start_ns) / 1e9
            if waited_s >= wait_s:
                self._node.log.error(f"Action client not connected: {self.name}")
                return False
            if waited_s > min(_WARN_S, wait_s / 2.0) and not warned:
                warned = True
                self._node.log.warn(f"Waiting for {self.name} to come up...")
            await asyncio.sleep(_POLL_S)
        return True

    async def run(self, goal: dict[str, Any]) -> "tuple[int, Message | None]":
        """Send a goal; returns its last state (of actionlib_msgs/GoalStatus) and its result."""
        done: asyncio.Future[int] = asyncio.get_running_loop().create_future()

        def end(state: int) -> None:
            self._node.loop.call_soon(lambda: None if done.done() else done.set_result(state))

        self._client.send(goal, end)
        try:
            state = await done
        except asyncio.CancelledError:
            self._client.cancel()
            raise
        return state, self._client.result
