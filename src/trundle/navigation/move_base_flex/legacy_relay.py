"""mbf_costmap_nav/move_base_legacy_relay.py: move_base's names for a move_base_flex."""

import asyncio
from collections.abc import Callable
from typing import Any

from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.private_parameters import private_parameters
from trundle.robots.parameters import ParamError
from trundle.ros import SUCCEEDED, ActionClient, ActionResult, ActionServer, Message, Node


class LegacyRelay:
    """Forwards the action and the topic of move_base to `move_base_flex/move_base`.

    Parameters, with the original's names: base_local_planner and base_global_planner, whose class names are those of
    the controller and the planner; base_name move_base_flex.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node

    async def run(self) -> int:
        """Relay until cancelled."""
        node = self._node
        try:
            parameters = await private_parameters(node)
            self._controller, self._planner = (
                parameters.text(name, "").rpartition("/")[2] for name in ("base_local_planner", "base_global_planner")
            )
            base = parameters.text("base_name", "move_base_flex")
        except ParamError as error:
            node.log.fatal(str(error))
            return 1
        self._client = ActionClient(node, f"{base}/move_base", "mbf_msgs/MoveBase")
        self._goals = node.advertise("move_base/goal", "move_base_msgs/MoveBaseActionGoal", queue_size=1)
        self._server = ActionServer(node, "move_base", "move_base_msgs/MoveBase", self._execute)
        # After the server, which would not hear of a goal that is latched there.
        node.subscribe("move_base_simple/goal", "geometry_msgs/PoseStamped", self._on_goal, queue_size=1)
        await node.closed.wait()
        return 0

    def _on_goal(self, message: Any) -> None:
        header = {"stamp": self._node.clock.now_ns()}
        self._goals.publish({"header": header, "goal": {"target_pose": message}})

    async def _execute(self, goal: Message, accept: Callable[[], None]) -> ActionResult:
        accept()
        ended = asyncio.Event()
        states: list[int] = []

        def end(state: int) -> None:
            states.append(state)
            self._node.loop.call_soon(ended.set)

        fields = {"target_pose": goal.target_pose, "controller": self._controller, "planner": self._planner}
        self._client.send(
            fields,
            end,
            lambda message: self._server.publish_feedback({"base_position": message.current_pose}, goal=goal),
        )
        try:
            await ended.wait()
        except asyncio.CancelledError:
            self._client.cancel()
            raise
        result = self._client.result
        text = "" if result is None else str(result.message)
        return ActionResult(status="succeeded" if states[0] == SUCCEEDED else "aborted", text=text)
