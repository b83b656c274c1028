"""Server of an action, with any number of goals."""

import threading
from collections.abc import Callable
from typing import Any

from actionlib_msgs.msg import GoalID, GoalStatus, GoalStatusArray

import rospy

from .action_types import ActionTypes
from .goal_id_generator import GoalIDGenerator
from .handle_tracker_deleter import HandleTrackerDeleter
from .server_goal_handle import ServerGoalHandle
from .status_tracker import StatusTracker


def nop_cb(goal_handle: object) -> None:
    """Ignore a goal."""


class ActionServer(ActionTypes):
    """Receives goals, and reports their status to their clients."""

    def __init__(
        self,
        ns: str,
        ActionSpec: type,
        goal_cb: Callable[..., object],
        cancel_cb: Callable[..., object] = nop_cb,
        auto_start: bool = True,
    ) -> None:
        """Prepare the action `ns`.

        Args:
            ns: action's name.
            ActionSpec: XAction class.
            goal_cb: called with the ServerGoalHandle of each new goal.
            cancel_cb: called with the ServerGoalHandle of each goal to cancel.
            auto_start: start at once; callbacks may then run before the constructor ends, so rather pass False and
                call `start`.

        Raises:
            ActionException: the class is not an action.
        """
        super().__init__(ActionSpec)
        self.ns = ns
        self.goal_callback = goal_cb
        assert self.goal_callback
        self.cancel_callback = cancel_cb
        self.auto_start = auto_start
        self.goal_sub: Any = None
        self.cancel_sub: Any = None
        self.status_pub: Any = None
        self.result_pub: Any = None
        self.feedback_pub: Any = None
        self.status_timer: rospy.Timer | None = None
        self.lock = threading.RLock()
        self.status_list: list[StatusTracker] = []
        self.last_cancel = rospy.Time()
        self.status_list_timeout = rospy.Duration()
        self.id_generator = GoalIDGenerator()
        self.started = False
        if auto_start:
            rospy.logwarn(f"action {ns}: auto_start=True may call back too early; pass False, and call start()")
            self.start()

    def register_goal_callback(self, cb: Callable[..., object]) -> None:
        """Replace the goal callback."""
        self.goal_callback = cb

    def register_cancel_callback(self, cancel_cb: Callable[..., object]) -> None:
        """Replace the cancel callback."""
        self.cancel_callback = cancel_cb

    def start(self) -> None:
        """Advertise and subscribe to the action's topics."""
        with self.lock:
            self.initialize()
            self.started = True
            self.publish_status()

    def stop(self) -> None:
        """Unregister from the action's topics; no goal should be running."""
        with self.lock:
            self.started = False
            if self.status_timer:
                self.status_timer.shutdown()
            for endpoint in (self.goal_sub, self.cancel_sub, self.status_pub, self.feedback_pub, self.result_pub):
                endpoint.unregister()

    def initialize(self) -> None:
        """Advertise, subscribe, and start the timer of the status."""
        name = rospy.remap_name(self.ns)
        pub_queue = rospy.get_param("actionlib_server_pub_queue_size", 50)
        self.pub_queue_size = pub_queue if pub_queue >= 0 else 50
        options: dict[str, Any] = {"queue_size": self.pub_queue_size}
        self.status_pub = rospy.Publisher(f"{name}/status", GoalStatusArray, latch=True, **options)
        self.result_pub = rospy.Publisher(f"{name}/result", self.ActionResult, **options)
        self.feedback_pub = rospy.Publisher(f"{name}/feedback", self.ActionFeedback, **options)
        sub_queue = rospy.get_param("actionlib_server_sub_queue_size", -1)
        self.sub_queue_size = sub_queue if sub_queue >= 0 else None
        options = {"queue_size": self.sub_queue_size}
        self.goal_sub = rospy.Subscriber(
            f"{name}/goal", self.ActionGoal, callback=self.internal_goal_callback, **options
        )
        self.cancel_sub = rospy.Subscriber(f"{name}/cancel", GoalID, callback=self.internal_cancel_callback, **options)
        self.status_frequency = self._status_frequency(name)
        self.status_list_timeout = rospy.Duration(rospy.get_param(f"{name}/status_list_timeout", 5.0))
        if self.status_frequency > 0.0:
            period = rospy.Duration(1.0 / self.status_frequency)
            self.status_timer = rospy.Timer(period, self.publish_status_async)

    def _status_frequency(self, name: str) -> float:
        """Rate of the status [Hz], from the parameters."""
        old = f"{name}/status_frequency"
        if rospy.has_param(old):
            rospy.logwarn(f"the parameter {old} is deprecated; use actionlib_status_frequency")
            return rospy.get_param(old, 5.0)
        param = rospy.search_param("actionlib_status_frequency")
        return 5.0 if param is None else rospy.get_param(param, 5.0)

    def publish_result(self, status: Any, result: Any) -> None:
        """Send a result, then the status."""
        with self.lock:
            self._publish(self.result_pub, self.ActionResult(status=status, result=result))
            self.publish_status()

    def publish_feedback(self, status: Any, feedback: Any) -> None:
        """Send feedback."""
        with self.lock:
            self._publish(self.feedback_pub, self.ActionFeedback(status=status, feedback=feedback))

    def publish_status_async(self, event: object) -> None:
        """Send the status; called by the timer."""
        with self.lock:
            if self.started:
                self.publish_status()

    def publish_status(self) -> None:
        """Send the status of all goals, and forget those that ended over `status_list_timeout` ago."""
        with self.lock:
            now = rospy.Time.now()
            self.status_list = [
                tracker
                for tracker in self.status_list
                if tracker.handle_destruction_time == rospy.Time()
                or tracker.handle_destruction_time + self.status_list_timeout >= now
            ]
            self._publish(
                self.status_pub, GoalStatusArray(status_list=[tracker.status for tracker in self.status_list])
            )

    def _publish(self, publisher: rospy.Publisher, message: Any) -> None:
        message.header.stamp = rospy.Time.now()
        if not rospy.is_shutdown():
            publisher.publish(message)

    def internal_goal_callback(self, goal: Any) -> None:
        """Handle a goal of the topic."""
        with self.lock:
            if not self.started:
                return
            known = self._find_tracker(goal.goal_id.id)
            if known is not None:
                self._repeat_goal(known)
                return
            tracker = StatusTracker(None, None, goal)
            self.status_list.append(tracker)
            handle = self._handle(tracker)
            if goal.goal_id.stamp != rospy.Time() and goal.goal_id.stamp <= self.last_cancel:
                handle.set_canceled(None, "the goal is not newer than the last cancel request")
            else:
                self.goal_callback(handle)

    def _find_tracker(self, goal_id: str) -> StatusTracker | None:
        return next((tracker for tracker in self.status_list if tracker.status.goal_id.id == goal_id), None)

    def _repeat_goal(self, tracker: StatusTracker) -> None:
        """Handle a goal with a known ID: sent twice, or canceled before it arrived."""
        if tracker.status.status == GoalStatus.RECALLING:
            tracker.status.status = GoalStatus.RECALLED
            self.publish_result(tracker.status, self.ActionResultType())
        if tracker.handle_tracker is None:
            tracker.handle_destruction_time = rospy.Time.now()

    def internal_cancel_callback(self, goal_id: Any) -> None:
        """Handle a cancel request of the topic: of one ID, of all up to a time, or (both zero) of all."""
        with self.lock:
            if not self.started:
                return
            is_timed = goal_id.stamp != rospy.Time()
            for tracker in list(self.status_list):
                status = tracker.status
                if (
                    goal_id.id == status.goal_id.id
                    or (is_timed and status.goal_id.stamp <= goal_id.stamp)
                    or (not is_timed and goal_id.id == "")
                ):
                    handle = self._handle(tracker)
                    if handle.set_cancel_requested():
                        self.cancel_callback(handle)
            if goal_id.id and self._find_tracker(goal_id.id) is None:
                tracker = StatusTracker(goal_id, GoalStatus.RECALLING)  # the goal may still arrive
                tracker.handle_destruction_time = rospy.Time.now()
                self.status_list.append(tracker)
            self.last_cancel = max(self.last_cancel, goal_id.stamp)

    def _handle(self, tracker: StatusTracker) -> ServerGoalHandle:
        if tracker.handle_tracker is None:
            tracker.handle_tracker = HandleTrackerDeleter(self, tracker)
        return ServerGoalHandle(tracker, self, tracker.handle_tracker)
