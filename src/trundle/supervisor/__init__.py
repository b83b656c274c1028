"""Processes and tasks: started, watched over, respawned, stopped; no ROS in here."""

from .job import Job, JobError, Patience, Policy
from .process import Command, ProcessJob
from .process_tree import ProcessTree
from .supervisor import Event, EventKind, Supervisor
from .task import TaskJob

__all__ = [
    "Command",
    "Event",
    "EventKind",
    "Job",
    "JobError",
    "Patience",
    "Policy",
    "ProcessJob",
    "ProcessTree",
    "Supervisor",
    "TaskJob",
]
