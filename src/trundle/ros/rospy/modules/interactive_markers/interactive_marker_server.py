"""Server of interactive markers."""

from collections.abc import Callable
from threading import RLock
from typing import Any

from std_msgs.msg import Header
from visualization_msgs.msg import (
    InteractiveMarker,
    InteractiveMarkerFeedback,
    InteractiveMarkerInit,
    InteractiveMarkerPose,
    InteractiveMarkerUpdate,
)

import rospy

_OWNERSHIP_S = 1.0
"""Time for which a marker that a client moves ignores other clients [s]."""
_NO_HEADER = Header()


_FeedbackCallback = Callable[[Any], object]


class MarkerContext:
    """State of a published marker."""

    def __init__(self) -> None:
        self.last_feedback = rospy.Time.now()
        self.last_client_id = ""
        self.default_feedback_cb: _FeedbackCallback | None = None
        self.feedback_cbs: dict[int, _FeedbackCallback] = {}
        self.int_marker = InteractiveMarker()


class UpdateContext:
    """Pending change, sent by `applyChanges`."""

    FULL_UPDATE = 0
    POSE_UPDATE = 1
    ERASE = 2

    def __init__(self, update_type: int = FULL_UPDATE) -> None:
        self.update_type = update_type
        self.int_marker = InteractiveMarker()
        self.default_feedback_cb: _FeedbackCallback | None = None
        self.feedback_cbs: dict[int, _FeedbackCallback] = {}


class InteractiveMarkerServer:
    """Publishes markers, and calls functions with their feedback. `applyChanges` sends changes."""

    DEFAULT_FEEDBACK_CB = 255

    def __init__(self, topic_ns: str, server_id: str = "", q_size: int = 100) -> None:
        """Advertise and subscribe to the topics.

        Args:
            topic_ns: topics' namespace, as in rviz's display.
            server_id: distinguishes the servers of one node.
            q_size: maximum number of queued feedback messages.
        """
        self.topic_ns = topic_ns
        self.seq_num = 0
        self.mutex = RLock()
        self.server_id = rospy.get_name() + server_id
        self.marker_contexts: dict[str, MarkerContext] = {}
        self.pending_updates: dict[str, UpdateContext] = {}
        self.init_pub = rospy.Publisher(f"{topic_ns}/update_full", InteractiveMarkerInit, latch=True, queue_size=100)
        self.update_pub = rospy.Publisher(f"{topic_ns}/update", InteractiveMarkerUpdate, queue_size=100)
        self.feedback_sub = rospy.Subscriber(
            f"{topic_ns}/feedback", InteractiveMarkerFeedback, self.processFeedback, queue_size=q_size
        )
        self.keep_alive_timer = rospy.Timer(rospy.Duration(0.5), self.keepAlive, reset=True)
        self.publishInit()

    def insert(self, marker: Any, feedback_cb: Any = -1, feedback_type: int = DEFAULT_FEEDBACK_CB) -> None:
        """Add or replace an InteractiveMarker.

        Args:
            marker: InteractiveMarker; one of the same name is replaced.
            feedback_cb: called with each InteractiveMarkerFeedback; -1: unchanged.
            feedback_type: event type that the function handles; default: all types without a function.
        """
        with self.mutex:
            update = self.pending_updates.setdefault(marker.name, UpdateContext())
            update.update_type = UpdateContext.FULL_UPDATE
            update.int_marker = marker
        if feedback_cb != -1:
            self.setCallback(marker.name, feedback_cb, feedback_type)

    def setPose(self, name: str, pose: Any, header: Any = _NO_HEADER) -> bool:
        """Move a marker; without a frame in the header it keeps its frame. False if there is no such marker."""
        with self.mutex:
            context, update = self.marker_contexts.get(name), self.pending_updates.get(name)
            if context is None or (update is not None and update.update_type == UpdateContext.FULL_UPDATE):
                return False
            self.doSetPose(update, name, pose, header if header.frame_id else context.int_marker.header)
            return True

    def erase(self, name: str) -> bool:
        """Remove a marker; False if there is no such marker."""
        with self.mutex:
            if name in self.pending_updates:
                self.pending_updates[name].update_type = UpdateContext.ERASE
            elif name in self.marker_contexts:
                self.pending_updates[name] = UpdateContext(UpdateContext.ERASE)
            else:
                return False
            return True

    def clear(self) -> None:
        """Remove all markers."""
        with self.mutex:
            self.pending_updates = {name: UpdateContext(UpdateContext.ERASE) for name in self.marker_contexts}

    def setCallback(
        self, name: str, feedback_cb: _FeedbackCallback | None, feedback_type: int = DEFAULT_FEEDBACK_CB
    ) -> bool:
        """Set a marker's function, see `insert`; None removes it. False if there is no such marker."""
        with self.mutex:
            contexts = [table[name] for table in (self.marker_contexts, self.pending_updates) if name in table]
            for context in contexts:
                if feedback_type == self.DEFAULT_FEEDBACK_CB:
                    context.default_feedback_cb = feedback_cb
                elif feedback_cb:
                    context.feedback_cbs[feedback_type] = feedback_cb
                else:
                    context.feedback_cbs.pop(feedback_type, None)
            return bool(contexts)

    def applyChanges(self) -> None:
        """Send all changes since the last call."""
        with self.mutex:
            if not self.pending_updates:
                return
            message = InteractiveMarkerUpdate(type=InteractiveMarkerUpdate.UPDATE)
            for name, update in self.pending_updates.items():
                self._apply(name, update, message)
            self.pending_updates = {}
            self.seq_num += 1
        self.publish(message)
        self.publishInit()

    def _apply(self, name: str, update: UpdateContext, message: Any) -> None:
        context = self.marker_contexts.get(name)
        if update.update_type == UpdateContext.FULL_UPDATE:
            if context is None:
                context = self.marker_contexts[name] = MarkerContext()
                context.default_feedback_cb = update.default_feedback_cb
                context.feedback_cbs = update.feedback_cbs
            context.int_marker = update.int_marker
            message.markers.append(context.int_marker)
        elif context is not None and update.update_type == UpdateContext.POSE_UPDATE:
            marker = context.int_marker
            marker.pose, marker.header = update.int_marker.pose, update.int_marker.header
            message.poses.append(InteractiveMarkerPose(header=marker.header, pose=marker.pose, name=marker.name))
        elif context is not None:
            del self.marker_contexts[name]
            message.erases.append(name)

    def get(self, name: str) -> Any:
        """Marker with its pending changes; None if there is no such marker."""
        with self.mutex:
            context, update = self.marker_contexts.get(name), self.pending_updates.get(name)
            if update is None:
                return None if context is None else context.int_marker
            if update.update_type == UpdateContext.FULL_UPDATE:
                return update.int_marker
            if context is None or update.update_type == UpdateContext.ERASE:
                return None
            context.int_marker.pose = update.int_marker.pose
            return context.int_marker

    def processFeedback(self, feedback: Any) -> None:
        """Handle a feedback message of the topic."""
        with self.mutex:
            context = self.marker_contexts.get(feedback.marker_name)
            if context is None:
                return
            now = rospy.Time.now()
            is_other = context.last_client_id != feedback.client_id
            if is_other and (now - context.last_feedback).to_sec() < _OWNERSHIP_S:
                return
            context.last_feedback = now
            context.last_client_id = feedback.client_id
            if feedback.event_type == InteractiveMarkerFeedback.POSE_UPDATE:
                is_untimed = context.int_marker.header.stamp == rospy.Time()
                header = context.int_marker.header if is_untimed else feedback.header
                update = self.pending_updates.get(feedback.marker_name)
                self.doSetPose(update, feedback.marker_name, feedback.pose, header)
            callback = context.feedback_cbs.get(feedback.event_type, context.default_feedback_cb)
        if callback:
            callback(feedback)

    def keepAlive(self, msg: object) -> None:
        """Send a keep-alive message to the clients."""
        self.publish(InteractiveMarkerUpdate(type=InteractiveMarkerUpdate.KEEP_ALIVE))

    def publish(self, update: Any) -> None:
        """Send an update."""
        update.server_id = self.server_id
        update.seq_num = self.seq_num
        self.update_pub.publish(update)

    def publishInit(self) -> None:
        """Publish all markers, latched for later clients."""
        with self.mutex:
            markers = [context.int_marker for context in self.marker_contexts.values()]
            self.init_pub.publish(
                InteractiveMarkerInit(server_id=self.server_id, seq_num=self.seq_num, markers=markers)
            )

    def doSetPose(self, update: UpdateContext | None, name: str, pose: Any, header: Any) -> None:
        """Set a marker's new pose, in its pending update or a new one."""
        if update is None:
            update = self.pending_updates[name] = UpdateContext(UpdateContext.POSE_UPDATE)
        elif update.update_type != UpdateContext.FULL_UPDATE:
            update.update_type = UpdateContext.POSE_UPDATE
        update.int_marker.pose = pose
        update.int_marker.header = header
