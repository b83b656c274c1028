"""Diagnostic tasks: each fills a status."""

import threading
from collections.abc import Callable
from typing import Any

from .status import DiagnosticStatusWrapper


class DiagnosticTask:
    """Base class of tasks."""

    def __init__(self, name: str) -> None:
        self.name = name

    def getName(self) -> str:
        """The task's name."""
        return self.name

    def run(self, stat: Any) -> Any:
        """Fill a status and return it."""
        return stat


class FunctionDiagnosticTask(DiagnosticTask):
    """Task of a function that fills a status."""

    def __init__(self, name: str, fn: Callable[[Any], Any]) -> None:
        super().__init__(name)
        self.fn = fn

    def run(self, stat: Any) -> Any:
        """Call the function."""
        return self.fn(stat)


class CompositeDiagnosticTask(DiagnosticTask):
    """Several tasks that fill one status; their summaries are merged."""

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.tasks: list[DiagnosticTask] = []

    def addTask(self, t: DiagnosticTask) -> None:
        """Add a task."""
        self.tasks.append(t)

    def run(self, stat: Any) -> Any:
        """Run all tasks."""
        combined, original = DiagnosticStatusWrapper(), DiagnosticStatusWrapper()
        original.summary(stat)
        for task in self.tasks:
            stat.summary(original)
            stat = task.run(stat)
            combined.mergeSummary(stat)
        stat.summary(combined)
        return stat


class DiagnosticTaskVector:
    """Tasks by name, each with a status of its own."""

    class DiagnosticTaskInternal:
        """A name and its function."""

        def __init__(self, name: str, fn: Callable[[Any], Any]) -> None:
            self.name = name
            self.fn = fn

        def run(self, stat: Any) -> Any:
            """Call the function."""
            stat.name = self.name
            return self.fn(stat)

    def __init__(self) -> None:
        self.tasks: list[DiagnosticTaskVector.DiagnosticTaskInternal] = []
        self.lock = threading.Lock()

    def addedTaskCallback(self, task: DiagnosticTaskInternal) -> None:
        """Hook for subclasses, called with each new task."""

    def add(self, *args: Any) -> None:
        """Add a DiagnosticTask, or a name and a function that fills a status."""
        name, function = (args[0].getName(), args[0].run) if len(args) == 1 else args
        task = self.DiagnosticTaskInternal(name, function)
        with self.lock:
            self.tasks.append(task)
            self.addedTaskCallback(task)

    def removeByName(self, name: str) -> bool:
        """Remove the first task of a name; False if there is none."""
        with self.lock:
            task = next((task for task in self.tasks if task.name == name), None)
            if task is not None:
                self.tasks.remove(task)
            return task is not None
