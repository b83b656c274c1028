"""Runs a node's tasks periodically and publishes their statuses."""

from typing import Any

from diagnostic_msgs.msg import DiagnosticArray

import rospy

from .status import ERROR, DiagnosticStatusWrapper
from .tasks import DiagnosticTaskVector

_PARAMETER_PERIOD = rospy.Duration(0.25)
"""Interval between two reads of the parameter ~diagnostic_period."""


class Updater(DiagnosticTaskVector):
    """Publisher of /diagnostics; call `update` often."""

    def __init__(self) -> None:
        super().__init__()
        self.publisher = rospy.Publisher("/diagnostics", DiagnosticArray, queue_size=10)
        self.last_time = rospy.Time.now()
        self.last_time_period_checked = self.last_time
        self.period = 1
        self.verbose = False
        self.hwid = ""
        self.warn_nohwid_done = False

    def update(self) -> None:
        """Publish, if ~diagnostic_period (1 s) has passed."""
        now = rospy.Time.now()
        if now >= self.last_time_period_checked + _PARAMETER_PERIOD:
            self.period = rospy.get_param_cached("~diagnostic_period", 1)
            self.last_time_period_checked = now
        if now >= self.last_time + rospy.Duration(self.period):
            self.force_update()

    def force_update(self) -> None:
        """Run all tasks and publish now."""
        self.last_time = rospy.Time.now()
        with self.lock:
            statuses = [self._run(task) for task in self.tasks]
        if not self.hwid and not self.warn_nohwid_done and not any(status.level for status in statuses):
            rospy.logwarn("diagnostic_updater: no hardware ID is set; call setHardwareID, with 'none' if there is none")
            self.warn_nohwid_done = True
        self.publish(statuses)

    def broadcast(self, lvl: int, msg: str) -> None:
        """Publish one level and message for all tasks."""
        statuses: list[Any] = []
        for task in self.tasks:
            statuses.append(DiagnosticStatusWrapper(name=task.name))
            statuses[-1].summary(lvl, msg)
        self.publish(statuses)

    def setHardwareID(self, hwid: str) -> None:
        """Set the name of the device that the statuses describe."""
        self.hwid = hwid

    def publish(self, msg: Any) -> None:
        """Publish one status or a list of them; each name is prefixed with the node's."""
        statuses = msg if isinstance(msg, list) else [msg]
        for status in statuses:
            status.name = f"{rospy.get_name()[1:]}: {status.name}"
        array = DiagnosticArray(status=statuses)
        array.header.stamp = rospy.Time.now()
        self.publisher.publish(array)

    def addedTaskCallback(self, task: DiagnosticTaskVector.DiagnosticTaskInternal) -> None:
        """Publish that a task starts."""
        status = DiagnosticStatusWrapper(name=task.name)
        status.summary(0, "Node starting up")
        self.publish(status)

    def _run(self, task: DiagnosticTaskVector.DiagnosticTaskInternal) -> Any:
        status = DiagnosticStatusWrapper(
            name=task.name, level=ERROR, message="No message was set", hardware_id=self.hwid
        )
        task.run(status)
        if self.verbose and status.level:
            rospy.logwarn(f"diagnostic status of '{status.name}' is {status.level}: {status.message}")
        return status
