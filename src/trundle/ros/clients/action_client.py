"""actionlib client on plain topics: one goal at a time."""

import itertools
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from ..node.graph_node import Node

if TYPE_CHECKING:
    from ..messages.raw_message import Message

_PATIENCE_NS = 1_000_000_000
"""Time after which what the server did not get is sent again: a goal that no status lists, a cancellation [ns]."""
_RUNNING = (0, 1)
"""States of a goal that is pending or active, constants of actionlib_msgs/GoalStatus."""
SUCCEEDED = 3
"""State of a goal that was reached, a constant of actionlib_msgs/GoalStatus."""
ABORTED = 4
"""State of a goal that the server gave up, another."""


class ActionClient:
    """Sends goals to an action's server; a new goal replaces the last one."""

    def __init__(self, node: Node, name: str, type_name: str) -> None:
        """Advertise and subscribe the action's topics.

        Args:
            node: node that publishes and subscribes.
            name: action's namespace, resolved like a topic.
            type_name: action type, such as 'move_base_msgs/MoveBase'.
        """
        self._node = node
        self._numbers = itertools.count(1)
        self._goal_id = ""
        self._message: dict[str, Any] = {}
        """The goal, which is sent again if the server did not receive it."""
        self._sent_ns = 0
        self._cancelled_id = ""
        """Goal that was cancelled last, until the server has it no longer."""
        self._cancelled_ns = 0
        self._has_status = False
        self._on_done: Callable[[int], object] | None = None
        self._on_feedback: Callable[[Message], object] | None = None
        self.result: Message | None = None
        """Result of the goal that ended last, set before `on_done` is called."""
        name = node.resolve(name)  # a remapping of the action's name holds for its topics
        self._goals = node.advertise(f"{name}/goal", f"{type_name}ActionGoal", queue_size=10)
        self._cancels = node.advertise(f"{name}/cancel", "actionlib_msgs/GoalID", queue_size=10)
        node.subscribe(f"{name}/status", "actionlib_msgs/GoalStatusArray", self._receive_status, queue_size=10)
        node.subscribe(f"{name}/result", f"{type_name}ActionResult", self._receive_result, queue_size=10)
        node.subscribe(f"{name}/feedback", f"{type_name}ActionFeedback", self._receive_feedback, queue_size=10)

    @property
    def has_server(self) -> bool:
        """True if a server reports its status, and the goal topic has a subscriber."""
        return self._has_status and self._goals.has_subscribers

    def send(
        self,
        goal: dict[str, Any],
        on_done: Callable[[int], object],
        on_feedback: "Callable[[Message], object] | None" = None,
    ) -> None:
        """Send a goal.

        Args:
            goal: fields of the goal.
            on_done: called with the goal's last state, unless another goal replaced it.
            on_feedback: called with each feedback.
        """
        now_ns = self._sent_ns = self._node.clock.now_ns()
        self._goal_id = f"{self._node.name}-{next(self._numbers)}-{now_ns / 1e9:.9f}"
        self._on_done, self._on_feedback = on_done, on_feedback
        goal_id = {"stamp": now_ns, "id": self._goal_id}
        self._message = {"header": {"stamp": now_ns}, "goal_id": goal_id, "goal": goal}
        self._goals.publish(self._message)

    def cancel(self) -> None:
        """Cancel the goal; its end is not reported any more."""
        goal_id = self._goal_id
        self._goal_id, self._on_done, self._on_feedback = "", None, None  # before another thread gets the result
        if goal_id:
            self._cancelled_id = goal_id
            self._send_cancellation()

    def _send_cancellation(self) -> None:
        self._cancelled_ns = self._node.clock.now_ns()
        self._cancels.publish({"id": self._cancelled_id})

    def _receive_status(self, message: Any) -> None:
        """Send a goal or a cancellation again that the server does not know, because it was not connected yet."""
        self._has_status = True
        now_ns = self._node.clock.now_ns()
        is_known = any(status.goal_id.id == self._goal_id for status in message.status_list)
        if self._goal_id and not is_known and not 0 <= now_ns - self._sent_ns < _PATIENCE_NS:
            self._sent_ns = now_ns
            self._goals.publish(self._message)
        if self._cancelled_id and not 0 <= now_ns - self._cancelled_ns < _PATIENCE_NS:
            goals = {status.goal_id.id: int(status.status) for status in message.status_list}
            if goals.get(self._cancelled_id) in _RUNNING:
                self._send_cancellation()
            else:
                self._cancelled_id = ""

    def _receive_result(self, message: Any) -> None:
        if message.status.goal_id.id == self._goal_id and self._on_done is not None:
            on_done = self._on_done
            self._goal_id, self._on_done, self._on_feedback = "", None, None
            self.result = message.result
            on_done(int(message.status.status))

    def _receive_feedback(self, message: Any) -> None:
        if message.status.goal_id.id == self._goal_id and self._on_feedback is not None:
            self._on_feedback(message.feedback)
