"""Runner of a launch plan's rows, each on its own graph, in lockstep with the nodes of this process."""

import io
import os
import time
from collections.abc import Generator
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from dataclasses import replace as replace_fields
from pathlib import Path
from tempfile import TemporaryDirectory

from trundle.base.diagnostics import TrundleError, UsageError
from trundle.live.launch.loaded_launch import LoadedLaunch
from trundle.live.launch.options import LaunchOptions
from trundle.live.launch.run_launch import read_files
from trundle.live.launch.running_nodes import RunningNodes
from trundle.live.launch.session import LaunchSession
from trundle.robots.launch import LaunchParam, ParamValue
from trundle.studies.plan_files.variation import Value

from .assignments import Assignments, assignments_of
from .judge import Judge
from .launch_check import check_launch
from .launch_inputs import launch_inputs
from .launch_setup import LaunchSetup
from .plan import Plan
from .plan_digest import RunInputs
from .row_result import RowResult
from .rows import Row
from .state_names import StateExpressions
from .topics import topics_of

_POLL_S = 0.01
_MAX_PAUSED_S = 30.0
"""Maximum wall time for which a world may stay paused while the launch is idle, as at the start of controllers."""


class LaunchRowRunner:
    """Runner of the rows of a launch plan, one after the other."""

    def __init__(self, plan: Plan) -> None:
        self._plan = plan
        self._expressions = StateExpressions()
        self._judge = Judge(plan, self._expressions)
        self._topics = topics_of(plan)

    def run(self, row: Row) -> RowResult:
        """Run a row to its end; errors are in its result."""
        return self._run(row, LaunchOptions(duration_s=self._plan.duration_s))

    def bag(self, row: Row, result: RowResult) -> bytes | None:
        """Run a row again and return the bag of its last seconds; None if it does not start."""
        assert self._plan.bag_s is not None
        if result.time is None:
            return None
        with TemporaryDirectory() as folder:
            file = Path(folder) / "last.bag"
            options = LaunchOptions(
                duration_s=self._plan.duration_s,
                record=file,
                record_from_s=result.time - self._plan.bag_s,
                record_without=self._plan.bag_without,
            )
            self._run(row, options)
            return file.read_bytes() if file.exists() else None

    def check(self, row: Row) -> list[str]:
        """Read the launch once with a row's values; return warnings.

        Raises:
            TrundleError: the plan cannot be run, with its line.
        """
        assigned = assignments_of(self._plan, row, self._expressions)
        with _quiet_environment() as environment:
            return check_launch(self._read_files(assigned, environment), assigned)

    def read(self, assigned: Assignments, environment: dict[str, str]) -> LoadedLaunch:
        """Read the launch with the arguments and parameters of a row.

        Raises:
            TrundleError: the launch cannot be read.
        """
        launch = self._read_files(assigned, environment)
        assigned_params = assigned.parameters
        at = self._plan.world_at
        params = [param for param in launch.params if param.name not in assigned_params]
        params += [LaunchParam(name=name, value=_parameter(value), at=at) for name, value in assigned_params.items()]
        return replace_fields(launch, params=params)

    def _read_files(self, assigned: Assignments, environment: dict[str, str]) -> LoadedLaunch:
        words = [*self._plan.world.split(), *(f"{name}:={value}" for name, value in assigned.arguments.items())]
        with assigned.unknown_arguments_at_plan():
            launch = read_files(words, LaunchOptions(), environment)
        assert launch is not None
        return launch

    def inputs(self, row: Row) -> RunInputs:
        """Return the inputs of a row.

        Raises:
            TrundleError: the launch cannot be read.
        """
        with _quiet_environment() as environment:
            return launch_inputs(self.read(assignments_of(self._plan, row, self._expressions), environment))

    def _run(self, row: Row, options: LaunchOptions) -> RowResult:
        output = io.StringIO()
        options = replace_fields(options, headless=True, speed=None)
        try:
            with redirect_stderr(output), redirect_stdout(output), self.session(row, options) as (session, setup):
                try:
                    self._wait(session, setup)
                except TrundleError as error:
                    return RowResult(row.number, "error", str(error), setup.time_s)
                return self.result(row, setup)
        except TrundleError as error:
            return RowResult(row.number, "error", str(error))

    @contextmanager
    def session(self, row: Row, options: LaunchOptions) -> Generator[tuple[LaunchSession, LaunchSetup]]:
        """Yield the launch of a row on its own graph, with its setup, before any node is started.

        Raises:
            TrundleError: the launch cannot be read.
        """
        options = replace_fields(options, summary=False, quiet=True, output="log")
        assigned = assignments_of(self._plan, row, self._expressions)
        setup = LaunchSetup(self._plan, row, assigned.properties, self._expressions, self._topics)
        with (
            _environment() as environment,
            LaunchSession(self.read(assigned, environment), options, ports=(0,), rosout=False, setup=setup) as session,
        ):
            yield session, setup

    def result(self, row: Row, setup: LaunchSetup) -> RowResult:
        """Return the result of a completed run."""
        try:
            setup.finish()
            measures = setup.script.measures() | self._judge.call_functions(setup.simulation)
            return self._judge.judged(row, setup.time_s or 0.0, measures, "")
        except TrundleError as error:
            return RowResult(row.number, "error", str(error), setup.time_s)

    def _wait(self, session: LaunchSession, setup: LaunchSetup) -> None:
        """Wait for the end of a run.

        Raises:
            TrundleError: the launch ended too early.
        """
        running = session.start(session.nodes)
        paused_s: float | None = None
        while not session.is_over:
            time.sleep(_POLL_S)
            check_running(running)
            if not session.is_paused or session.is_busy:
                paused_s = None
            elif setup.is_over:
                return
            elif paused_s is None:
                paused_s = time.monotonic()
            elif session.stop_reason is not None or time.monotonic() - paused_s > _MAX_PAUSED_S:
                raise UsageError(session.stop_reason or "the world stays paused")


def check_running(running: RunningNodes) -> None:
    """Check that a launch still has its required nodes and its world.

    Raises:
        UsageError: a required node died, or there is no world.
    """
    if running.required_died:
        raise UsageError("a required node died")
    if running.has_world_ended():
        raise UsageError("the launch has no world (a node of gazebo_ros), or it has ended")


@contextmanager
def _environment() -> Generator[dict[str, str]]:
    """Yield the environment of a launch on its own graph, with temporary logs."""
    with TemporaryDirectory(prefix="trundle-sweep-") as logs:
        environment = {name: value for name, value in os.environ.items() if name != "ROS_MASTER_URI"}
        yield environment | {"ROS_LOG_DIR": logs}


@contextmanager
def _quiet_environment() -> Generator[dict[str, str]]:
    """Yield the environment while output is suppressed."""
    output = io.StringIO()
    with redirect_stderr(output), redirect_stdout(output), _environment() as environment:
        yield environment


def _parameter(value: Value) -> ParamValue:
    return [_parameter(part) for part in value] if isinstance(value, tuple) else value
