"""Diagnostics of a node, on /diagnostics."""

from .publishers import DiagnosedPublisher, HeaderlessTopicDiagnostic, TopicDiagnostic
from .status import ERROR, OK, WARN, DiagnosticStatusWrapper
from .tasks import CompositeDiagnosticTask, DiagnosticTask, DiagnosticTaskVector, FunctionDiagnosticTask
from .topic_status import FrequencyStatus, FrequencyStatusParam, Heartbeat, TimeStampStatus, TimeStampStatusParam
from .updater import Updater

__all__ = [
    "ERROR",
    "OK",
    "WARN",
    "CompositeDiagnosticTask",
    "DiagnosedPublisher",
    "DiagnosticStatusWrapper",
    "DiagnosticTask",
    "DiagnosticTaskVector",
    "FrequencyStatus",
    "FrequencyStatusParam",
    "FunctionDiagnosticTask",
    "HeaderlessTopicDiagnostic",
    "Heartbeat",
    "TimeStampStatus",
    "TimeStampStatusParam",
    "TopicDiagnostic",
    "Updater",
]
