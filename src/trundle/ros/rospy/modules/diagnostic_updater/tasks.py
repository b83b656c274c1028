"""Diagnostic tasks: each fills a status when asked."""

import threading

from .status import DiagnosticStatusWrapper


class DiagnosticTask:
    """Base of tasks."""

    def __init__(self, name):
        self.name = name

    def getName(self):
        """The task's name."""
        return self.name

    def run(self, stat):
        """Fill a status and return it."""
        return stat


class FunctionDiagnosticTask(DiagnosticTask):
    """Task of a function that fills a status."""

    def __init__(self, name, fn):
        super().__init__(name)
        self.fn = fn

    def run(self, stat):
        """Call the function."""
        return self.fn(stat)


class CompositeDiagnosticTask(DiagnosticTask):
    """Several tasks that fill one status; their summaries are merged."""

    def __init__(self, name):
        super().__init__(name)
        self.tasks = []

    def addTask(self, t):
        """Add a task."""
        self.tasks.append(t)

    def run(self, stat):
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

        def __init__(self, name, fn):
            self.name = name
            self.fn = fn

        def run(self, stat):
            """Call the function."""
            stat.name = self.name
            return self.fn(stat)

    def __init__(self):
        self.tasks = []
        self.lock = threading.Lock()

    def addedTaskCallback(self, task):
        """Overridden by those who want to know of new tasks."""

    def add(self, *args):
        """Add a DiagnosticTask, or a name and a function that fills a status."""
        name, function = (args[0].getName(), args[0].run) if len(args) == 1 else args
        task = self.DiagnosticTaskInternal(name, function)
        with self.lock:
            self.tasks.append(task)
            self.addedTaskCallback(task)

    def removeByName(self, name):
        """Remove the first task of a name; False if there is none."""
        with self.lock:
            task = next((each for each in self.tasks if each.name == name), None)
            if task is not None:
                self.tasks.remove(task)
            return task is not None
