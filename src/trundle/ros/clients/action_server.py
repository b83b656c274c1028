"""actionlib server on plain topics: goal and cancel in; status, feedback and result out."""

import asyncio
import itertools
from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal

from ..messages.raw_message import Message
from ..node.clock import to_nsec
from ..node.graph_node import Node

if TYPE_CHECKING:
    from ..message_types import actionlib_msgs

_STATUS_RATE_HZ = 5.0
_STATUS_LIST_TIMEOUT_S = 5.0
"""Time a finished goal stays in the status list, as in actionlib."""
_PENDING, _ACTIVE = 0, 1
_NUMBERS = {"preempted": 2, "succeeded": 3, "aborted": 4, "rejected": 5, "recalled": 8}
_MAX_GOALS = 1000


@dataclass(frozen=True, slots=True, kw_only=True)
class ActionResult:
    """Terminal state and result of a goal."""

    status: Literal["succeeded", "aborted", "preempted", "rejected", "recalled"] = "succeeded"
    result: Mapping[str, object] = field(default_factory=dict[str, Any])
    text: str = ""


@dataclass(slots=True, kw_only=True)
class _Goal:
    id: dict[str, Any]
    stamp_ns: int
    message: Message
    status: int = _PENDING
    text: str = ""
    task: asyncio.Task[None] | None = None
    is_running: bool = False
    is_recalled: bool = False
    """True: cancelled before it ran."""
    ended_ns: int | None = None


class ActionServer:
    """Executes goals; unless `concurrent`, a new goal preempts the previous one."""

    def __init__(
        self,
        node: Node,
        name: str,
        type_name: str,
        work: Callable[[Message, Callable[[], None]], Awaitable[ActionResult]],
        *,
        concurrent: bool = False,
    ) -> None:
        """Advertise and subscribe the action's topics.

        Args:
            node: node that publishes and subscribes.
            name: action's namespace, resolved like a topic.
            type_name: action type, such as 'control_msgs/FollowJointTrajectory'.
            work: coroutine function of the goal and of `accept`, which it calls on the loop when it accepts the goal;
                it is cancelled with the goal.
            concurrent: True: goals run concurrently; `work` may preempt them.
        """
        self._node = node
        self._work = work
        self._concurrent = concurrent
        self._goals: dict[str, _Goal] = {}
        self._numbers = itertools.count(1)
        self._early_cancels: dict[str, int] = {}
        """ID → time of cancellations that came before their goals, on another connection [ns]."""
        name = node.resolve(name)  # a remapping of the action's name holds for its topics
        self._result = node.advertise(f"{name}/result", f"{type_name}ActionResult", queue_size=50)
        self._feedback = node.advertise(f"{name}/feedback", f"{type_name}ActionFeedback", queue_size=50)
        self._status = node.advertise(f"{name}/status", "actionlib_msgs/GoalStatusArray", latch=True, queue_size=50)
        goals = node.subscribe(f"{name}/goal", f"{type_name}ActionGoal", self._on_goal, queue_size=None, on_loop=True)
        cancels = node.subscribe(
            f"{name}/cancel", "actionlib_msgs/GoalID", self._on_cancel, queue_size=None, on_loop=True
        )
        self._name = name
        self._endpoints = (self._result, self._feedback, self._status, goals, cancels)
        self._status_task = node.loop.spawn(self._publish_status_loop())

    @property
    def active(self) -> bool:
        """True while a goal is active."""
        return any(goal.status == _ACTIVE for goal in self._goals.values())

    def publish_feedback(self, feedback: dict[str, object], *, goal: Message | None = None) -> None:
        """Publish feedback for all active goals, or for the one of the message `goal`; thread-safe."""
        if not self._feedback.has_subscribers:
            return
        for active in [active for active in list(self._goals.values()) if active.status == _ACTIVE]:
            if goal is None or active.message is goal:
                header = {"stamp": self._node.clock.now_ns()}
                self._feedback.publish({"header": header, "status": _status(active), "feedback": feedback})

    def close(self) -> None:
        """Unregister; thread-safe."""
        self._status_task.cancel()
        for endpoint in self._endpoints:
            endpoint.unregister()

    def _on_goal(self, message: Message) -> None:
        now = self._node.clock.now_ns()
        key = message.goal_id.id or f"{self._node.name}-{next(self._numbers)}-{now / 1e9:.9f}"
        stamp = to_nsec(message.goal_id.stamp) or now
        if key in self._goals:
            return
        if len(self._goals) >= _MAX_GOALS:
            self._node.log.error(f"more than {_MAX_GOALS} goals at once; a new goal is ignored")
            return
        if not self._concurrent:
            for other in self._goals.values():
                self._stop(other)
        goal = _Goal(id={"stamp": stamp, "id": key}, stamp_ns=stamp, message=message.goal)
        self._goals[key] = goal
        goal.is_recalled = self._early_cancels.pop(key, None) is not None
        goal.task = asyncio.get_running_loop().create_task(self._run(goal, message.goal))

    def _on_cancel(self, message: "actionlib_msgs.GoalID") -> None:
        """Cancel by ID; an empty ID means all goals, a stamp all goals up to that time."""
        stamp = to_nsec(message.stamp)
        for key, goal in self._goals.items():
            everything = not message.id and stamp == 0
            if everything or key == message.id or (stamp and goal.stamp_ns <= stamp):
                self._stop(goal)
        if message.id and message.id not in self._goals and len(self._early_cancels) < _MAX_GOALS:
            self._early_cancels[message.id] = self._node.clock.now_ns()

    def _stop(self, goal: _Goal) -> None:
        if not goal.is_running:
            goal.is_recalled = True  # a task that is cancelled before it runs would publish no result
        elif goal.task is not None and goal.status in (_PENDING, _ACTIVE):
            goal.task.cancel()

    async def _run(self, goal: _Goal, message: Message) -> None:
        def accept() -> None:
            if goal.status == _PENDING:  # unless the goal was cancelled meanwhile
                goal.status = _ACTIVE
                self._publish_status()

        goal.is_running = True
        fault: Exception | None = None
        try:
            result = ActionResult(status="recalled") if goal.is_recalled else await self._work(message, accept)
        except asyncio.CancelledError:
            result = ActionResult(status="preempted")
        except Exception as error:  # raised again below: a goal without a result would be waited for
            fault, result = error, ActionResult(status="aborted", text=f"{type(error).__name__}: {error}")
        goal.status, goal.text = _NUMBERS[result.status], result.text
        goal.ended_ns = self._node.clock.now_ns()
        self._publish_status()
        header = {"stamp": goal.ended_ns}
        self._result.publish({"header": header, "status": _status(goal), "result": result.result})
        if fault is not None:
            self._node.log.error(f"{self._name}: {goal.text}")
            raise fault

    async def _publish_status_loop(self) -> None:
        while not self._node.closed.is_set():
            now = self._node.clock.now_ns()
            old = [
                k
                for k, g in self._goals.items()
                if g.ended_ns is not None and now - g.ended_ns > _STATUS_LIST_TIMEOUT_S * 1e9
            ]
            for key in old:
                del self._goals[key]
            for key, cancelled_ns in list(self._early_cancels.items()):
                if now - cancelled_ns > _STATUS_LIST_TIMEOUT_S * 1e9:
                    del self._early_cancels[key]
            self._publish_status()
            await self._node.clock.sleep(1.0 / _STATUS_RATE_HZ)

    def _publish_status(self) -> None:
        statuses = [_status(goal) for goal in self._goals.values()]
        self._status.publish({"header": {"stamp": self._node.clock.now_ns()}, "status_list": statuses})


def _status(goal: _Goal) -> dict[str, Any]:
    return {"goal_id": goal.id, "status": goal.status, "text": goal.text}
