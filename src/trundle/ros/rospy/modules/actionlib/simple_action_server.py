"""Server of an action, with one goal at a time: a newer goal preempts the older."""

import threading
import traceback

from actionlib_msgs.msg import GoalStatus

import rospy

from .action_server import ActionServer
from .server_goal_handle import ServerGoalHandle

_SUPERSEDED = "This goal was canceled because another goal was received by the simple action server"


def nop_cb(goal_handle):
    """Ignore a goal."""


class SimpleActionServer:
    """Runs one goal, by a blocking callback or by polling."""

    def __init__(self, name, ActionSpec, execute_cb=None, auto_start=True):
        """Prepare the action `name`.

        Args:
            name: of the action.
            ActionSpec: its XAction class.
            execute_cb: called with each XGoal on a thread of its own; it should call set_succeeded or another end.
            auto_start: start at once; see ActionServer.
        """
        self.new_goal = False
        self.preempt_request = False
        self.new_goal_preempt_request = False
        self.execute_callback = execute_cb
        self.goal_callback = None
        self.preempt_callback = None
        self.need_to_terminate = False
        self.terminate_mutex = threading.RLock()
        # Taken after action_server.lock, which is held while goals and cancel requests come in.
        self.lock = threading.RLock()
        self.execute_condition = threading.Condition(self.lock)
        self.current_goal = ServerGoalHandle()
        self.next_goal = ServerGoalHandle()
        self.action_server = ActionServer(
            name, ActionSpec, self.internal_goal_callback, self.internal_preempt_callback, False
        )
        self.execute_thread = None
        if execute_cb:
            self.execute_thread = threading.Thread(target=self.executeLoop)
            self.execute_thread.start()
        if auto_start:
            rospy.logwarn(f"action {name}: auto_start=True may call back too early; pass False, and call start()")
            self.start()

    def __del__(self):
        if getattr(self, "execute_thread", None):
            with self.execute_condition:
                self.need_to_terminate = True
                self.execute_condition.notify_all()
            if self.execute_thread is not threading.current_thread():
                self.execute_thread.join()

    def accept_new_goal(self):
        """Start the next goal, preempting the current one; returns its XGoal, or None if there is none."""
        with self.action_server.lock, self.lock:
            if not self.new_goal or not self.next_goal.get_goal():
                rospy.logerr("accept_new_goal without a new goal; ask is_new_goal_available first")
                return None
            if self.is_active() and self.current_goal.get_goal() and self.current_goal != self.next_goal:
                self.current_goal.set_canceled(None, _SUPERSEDED)
            self.current_goal = self.next_goal
            self.new_goal = False
            self.preempt_request = self.new_goal_preempt_request
            self.new_goal_preempt_request = False
            self.current_goal.set_accepted("This goal has been accepted by the simple action server")
            return self.current_goal.get_goal()

    def is_new_goal_available(self):
        """True if `accept_new_goal` would return one."""
        return self.new_goal

    def is_preempt_requested(self):
        """True if the current goal should end: it was canceled, or a newer one came."""
        return self.preempt_request

    def is_active(self):
        """True if a goal is running."""
        if not self.current_goal.get_goal():
            return False
        return self.current_goal.get_goal_status().status in (GoalStatus.ACTIVE, GoalStatus.PREEMPTING)

    def set_succeeded(self, result=None, text=""):
        """End the goal as reached."""
        with self.action_server.lock, self.lock:
            self.current_goal.set_succeeded(result or self.get_default_result(), text)

    def set_aborted(self, result=None, text=""):
        """End the goal as failed."""
        with self.action_server.lock, self.lock:
            self.current_goal.set_aborted(result or self.get_default_result(), text)

    def set_preempted(self, result=None, text=""):
        """End the goal as canceled."""
        with self.action_server.lock, self.lock:
            self.current_goal.set_canceled(result or self.get_default_result(), text)

    def publish_feedback(self, feedback):
        """Send an XFeedback."""
        self.current_goal.publish_feedback(feedback)

    def get_default_result(self):
        """An empty XResult."""
        return self.action_server.ActionResultType()

    def register_goal_callback(self, cb):
        """Set a function that is called when a new goal can be accepted; not beside an execute callback."""
        if self.execute_callback:
            rospy.logwarn("register_goal_callback has no effect on a SimpleActionServer with an execute callback")
        else:
            self.goal_callback = cb

    def register_preempt_callback(self, cb):
        """Set a function that is called when the current goal should end."""
        self.preempt_callback = cb

    def start(self):
        """Go on the graph."""
        self.action_server.start()

    def internal_goal_callback(self, goal):
        """Take a goal from the ActionServer."""
        with self.execute_condition:
            if not all(self._is_newer(goal, than) for than in (self.current_goal, self.next_goal)):
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

    def internal_preempt_callback(self, preempt):
        """Take a cancel request from the ActionServer."""
        with self.lock:
            if preempt == self.current_goal:
                self.preempt_request = True
                if self.preempt_callback:
                    self.preempt_callback()
            elif preempt == self.next_goal:
                self.new_goal_preempt_request = True

    def executeLoop(self):
        """Run the execute callback for one goal after the other."""
        while not rospy.is_shutdown() and not self.need_to_terminate:
            if self.is_new_goal_available():
                self._execute(self.accept_new_goal())
            with self.execute_condition:
                if not self.new_goal and not self.need_to_terminate:
                    self.execute_condition.wait(0.1)

    def _execute(self, goal):
        try:
            self.execute_callback(goal)
            if self.is_active():
                rospy.logwarn("the execute callback returned without an end of its goal, which is now aborted")
                self.set_aborted(None, "No terminal state was set.")
        except Exception as error:
            rospy.logerr(f"Exception in your execute callback: {error}\n{traceback.format_exc()}")
            self.set_aborted(None, f"Exception in execute callback: {error}")

    @staticmethod
    def _is_newer(goal, than):
        return not than.get_goal() or goal.get_goal_id().stamp >= than.get_goal_id().stamp
