"""Server of an action, with one goal at a time: a newer goal preempts the older."""

import threading
import traceback
from collections.abc import Callable
from typing import Any

from actionlib_msgs.msg import GoalStatus

import rospy

from .action_server import ActionServer
from .server_goal_handle import ServerGoalHandle

_SUPERSEDED = "This goal was canceled because another goal was received by the simple action server"


def nop_cb(goal_handle: object) -> None:
    """Ignore a goal."""


class SimpleActionServer:
    """Runs one goal, by a blocking callback or by polling."""

    def __init__(
        self, name: str, ActionSpec: type, execute_cb: Callable[[Any], object] | None = None, auto_start: bool = True
    ) -> None:
        """Prepare the action `name`.

        Args:
            name: action's name.
            ActionSpec: XAction class.
            execute_cb: called with each XGoal on a thread of its own; should end the goal, as with set_succeeded.
            auto_start: start at once; see ActionServer.
        """
        self.new_goal = False
        self.preempt_request = False
        self.new_goal_preempt_request = False
        self.execute_callback = execute_cb
        self.goal_callback: Callable[[], object] | None = None
        self.preempt_callback: Callable[[], object] | None = None
        self.need_to_terminate = False
        self.terminate_mutex = threading.RLock()
        # Locked after action_server.lock, which is held while goals and cancel requests are handled.
        self.lock = threading.RLock()
        self.execute_condition = threading.Condition(self.lock)
        self.current_goal = ServerGoalHandle()
        self.next_goal = ServerGoalHandle()
        self.action_server = ActionServer(
            name, ActionSpec, self.internal_goal_callback, self.internal_preempt_callback, False
        )
        self.execute_thread: threading.Thread | None = None
        if execute_cb:
            self.execute_thread = threading.Thread(target=self.executeLoop)
            self.execute_thread.start()
        if auto_start:
            rospy.logwarn(f"action {name}: auto_start=True may call back too early; pass False, and call start()")
            self.start()

    def __del__(self) -> None:
        thread: threading.Thread | None = getattr(self, "execute_thread", None)
        if thread is not None:
            with self.execute_condition:
                self.need_to_terminate = True
                self.execute_condition.notify_all()
            if thread is not threading.current_thread():
                thread.join()

    def accept_new_goal(self) -> Any:
        """Start the next goal, preempting the current one; returns its XGoal, or None if there is none."""
        with self.action_server.lock, self.lock:
            if not self.new_goal or not self.next_goal.get_goal():
                rospy.logerr("accept_new_goal without a new goal; check is_new_goal_available first")
                return None
            if self.is_active() and self.current_goal.get_goal() and self.current_goal != self.next_goal:
                self.current_goal.set_canceled(None, _SUPERSEDED)
            self.current_goal = self.next_goal
            self.new_goal = False
            self.preempt_request = self.new_goal_preempt_request
            self.new_goal_preempt_request = False
            self.current_goal.set_accepted("This goal has been accepted by the simple action server")
            return self.current_goal.get_goal()

    def is_new_goal_available(self) -> bool:
        """True if `accept_new_goal` would return one."""
        return self.new_goal

    def is_preempt_requested(self) -> bool:
        """True if the current goal should end: it was canceled, or a newer one arrived."""
        return self.preempt_request

    def is_active(self) -> bool:
        """True if a goal is running."""
        if not self.current_goal.get_goal():
            return False
        return self.current_goal.get_goal_status().status in (GoalStatus.ACTIVE, GoalStatus.PREEMPTING)

    def set_succeeded(self, result: Any = None, text: str = "") -> None:
        """End the goal as reached."""
        with self.action_server.lock, self.lock:
            self.current_goal.set_succeeded(result or self.get_default_result(), text)

    def set_aborted(self, result: Any = None, text: str = "") -> None:
        """End the goal as failed."""
        with self.action_server.lock, self.lock:
            self.current_goal.set_aborted(result or self.get_default_result(), text)

    def set_preempted(self, result: Any = None, text: str = "") -> None:
        """End the goal as canceled."""
        with self.action_server.lock, self.lock:
            self.current_goal.set_canceled(result or self.get_default_result(), text)

    def publish_feedback(self, feedback: Any) -> None:
        """Send an XFeedback."""
        self.current_goal.publish_feedback(feedback)

    def get_default_result(self) -> Any:
        """An empty XResult."""
        return self.action_server.ActionResultType()

    def register_goal_callback(self, cb: Callable[[], object] | None) -> None:
        """Set a function that is called when a new goal can be accepted; no effect with an execute callback."""
        if self.execute_callback:
            rospy.logwarn("register_goal_callback has no effect on a SimpleActionServer with an execute callback")
        else:
            self.goal_callback = cb

    def register_preempt_callback(self, cb: Callable[[], object] | None) -> None:
        """Set a function that is called when the current goal should end."""
        self.preempt_callback = cb

    def start(self) -> None:
        """Start the ActionServer."""
        self.action_server.start()

    def internal_goal_callback(self, goal: ServerGoalHandle) -> None:
        """Handle a goal of the ActionServer."""
        with self.execute_condition:
            if not all(self._is_newer(goal, other) for other in (self.current_goal, self.next_goal)):
                goal.set_canceled(None, _SUPERSEDED)
                return
            if self.next_goal.get_goal() and (not self.current_goal.get_goal() or self.next_goal != self.current_goal):
                self.next_goal.set_canceled(None, _SUPERSEDED)
            self.next_goal = goal
            self.new_goal = True
            self.new_goal_preempt_request = False
            try:
                if self.is_active():
                    self.preempt_request = True
                    if self.preempt_callback:
                        self.preempt_callback()
                if self.goal_callback:
                    self.goal_callback()
            except Exception as error:
                rospy.logerr(f"SimpleActionServer: exception in a callback: {error}\n{traceback.format_exc()}")
            self.execute_condition.notify()

    def internal_preempt_callback(self, preempt: ServerGoalHandle) -> None:
        """Handle a cancel request of the ActionServer."""
        with self.lock:
            if preempt == self.current_goal:
                self.preempt_request = True
                if self.preempt_callback:
                    self.preempt_callback()
            elif preempt == self.next_goal:
                self.new_goal_preempt_request = True

    def executeLoop(self) -> None:
        """Run the execute callback for each goal in turn."""
        while not rospy.is_shutdown() and not self.need_to_terminate:
            if self.is_new_goal_available():
                self._execute(self.accept_new_goal())
            with self.execute_condition:
                if not self.new_goal and not self.need_to_terminate:
                    self.execute_condition.wait(0.1)

    def _execute(self, goal: Any) -> None:
        assert self.execute_callback is not None
        try:
            self.execute_callback(goal)
            if self.is_active():
                rospy.logwarn("the execute callback returned without ending its goal, which is aborted")
                self.set_aborted(None, "No terminal state was set.")
        except Exception as error:
            rospy.logerr(f"Exception in your execute callback: {error}\n{traceback.format_exc()}")
            self.set_aborted(None, f"Exception in execute callback: {error}")

    @staticmethod
    def _is_newer(goal: ServerGoalHandle, other: ServerGoalHandle) -> bool:
        return not other.get_goal() or goal.get_goal_id().stamp >= other.get_goal_id().stamp
