"""How an execution ended."""

import enum


class Outcome(enum.Enum):
    """moveit_controller_manager::ExecutionStatus, by its names."""

    SUCCEEDED = "SUCCEEDED"
    PREEMPTED = "PREEMPTED"
    TIMED_OUT = "TIMED_OUT"
    ABORTED = "ABORTED"
    FAILED = "FAILED"
