"""Execution of trajectories: which controllers, from where, for how long."""

import asyncio
from collections.abc import Sequence
from typing import Annotated

import msgspec
import numpy as np
from msgspec import Meta

from trundle.robots.parameters import RosParameters
from trundle.ros import Node
from trundle.spatial import NS_PER_S

from .controllers import Controller, ControllerSource, JointPath, Outcome, read_controllers
from .current_state_monitor import CurrentStateMonitor
from .robot_description import RobotDescription

_STATE_WAIT_S = 1.0
_STOP_WAIT_S = 1.0
_STILL = 1e-4
"""Motion between two looks below which the robot has stopped [rad] or [m]."""
_LOOK_S = 0.05


class ExecutionSettings(msgspec.Struct, kw_only=True):
    """Parameters of ~trajectory_execution, with the original's defaults and its dynamic_reconfigure's bounds."""

    execution_duration_monitoring: bool = True
    allowed_execution_duration_scaling: Annotated[float, Meta(ge=1.0, le=10.0)] = 1.1
    allowed_goal_duration_margin: Annotated[float, Meta(ge=0.1, le=30.0)] = 0.5
    execution_velocity_scaling: Annotated[float, Meta(ge=0.1, le=10.0)] = 1.0
    allowed_start_tolerance: Annotated[float, Meta(ge=0.0)] = 0.01
    wait_for_trajectory_completion: bool = True


class TrajectoryExecution:
    """Splits trajectories among controllers, and awaits their ends."""

    def __init__(
        self, node: Node, description: RobotDescription, monitor: CurrentStateMonitor, settings: ExecutionSettings
    ) -> None:
        """Make it without controllers; `open` reads them."""
        self._node = node
        self._model = description.model
        self._monitor = monitor
        self.settings = settings
        self._source: ControllerSource | None = None
        self._manages = True
        self._running: asyncio.Task[Outcome] | None = None
        self._joint_tolerances: dict[str, float] = {}

    def open(self, root: RosParameters) -> None:
        """Read the controllers, and listen to `trajectory_execution_event`.

        Raises:
            ParamError: the controllers' parameters are invalid.
        """
        node = self._node
        self._manages = root.flag("moveit_manage_controllers", default=True)
        self._source = read_controllers(node, root, self._model)
        tolerances = root.section("trajectory_execution").section("joints_allowed_start_tolerance")
        self._joint_tolerances = {name: tolerances.number(name, 0.0) for name in tolerances.names()}
        what = "managing" if self._manages else "not managing"
        node.log.info(f"Trajectory execution is {what} controllers")
        node.subscribe("trajectory_execution_event", "std_msgs/String", self._on_event, queue_size=100, on_loop=True)

    def _on_event(self, message: object) -> None:
        event = str(getattr(message, "data", ""))
        if event == "stop":
            self._node.log.info("Received event 'stop'")
            self.stop()
        else:
            self._node.log.warn(f"Unknown event type: '{event}'; events: stop")

    @property
    def is_running(self) -> bool:
        """True while a trajectory is executed."""
        return self._running is not None and not self._running.done()

    def stop(self) -> None:
        """Stop the motion; `execute` then returns PREEMPTED."""
        if self._running is not None and not self._running.done():
            self._running.cancel()
            self._node.log.info("Stopped trajectory execution.")

    async def execute(self, path: JointPath) -> Outcome:
        """Execute a path by the controllers of its joints; cancelling the call stops the motion."""
        if self.is_running:
            self._node.log.error("Cannot push a new trajectory while another is being executed")
            return Outcome.ABORTED
        moving = [name for name in path.joints if self._is_actuated(name)]
        if not path.joints:
            return self._refuse_no_joints()
        if len(path.times_s) == 0:
            return Outcome.SUCCEEDED
        base = self._moved_base(path)
        if base:
            self._node.log.error(f"no controller takes trajectories of planar and floating joints: {', '.join(base)}")
            return Outcome.ABORTED
        if path.duration_s == 0.0:
            return Outcome.SUCCEEDED  # nothing to do, and controllers refuse points that are due at once
        if not moving:
            return self._refuse_no_joints()
        controllers = await self._choose(moving)
        if controllers is None or not await self._starts_here(path):
            return Outcome.ABORTED
        self._running = asyncio.create_task(self._run(path, controllers))
        try:
            return await asyncio.shield(self._running)
        except asyncio.CancelledError:
            if self._running.cancelled():
                return Outcome.PREEMPTED
            self._running.cancel()
            raise

    def _refuse_no_joints(self) -> Outcome:
        self._node.log.warn("The trajectory to execute specifies no joints")
        return Outcome.ABORTED

    def _is_actuated(self, name: str) -> bool:
        if not self._model.has_joint(name):
            return False
        joint = self._model.joint(name)
        return bool(joint.variables) and joint.mimic is None and not joint.passive

    def _moved_base(self, path: JointPath) -> list[str]:
        """Return the planar and floating joints that a path moves."""
        joints = {v: joint.name for joint in self._model.joints if len(joint.variables) > 1 for v in joint.variables}
        spans = np.ptp(path.positions, axis=0)
        moved = (
            joints[name] for name, span in zip(path.joints, spans, strict=True) if name in joints and span > _STILL
        )
        return list(dict.fromkeys(moved))

    # -- which controllers

    async def _choose(self, joints: Sequence[str]) -> list[Controller] | None:
        """Return controllers that cover all joints, each of them needed, and start them; None if there are none."""
        if self._source is None:
            self._node.log.error("No controller manager: trajectories cannot be executed")
            return None
        known = list(await self._source.controllers())
        candidates = [controller for controller in known if set(controller.joints) & set(joints)]
        if not self._manages:
            candidates = [controller for controller in candidates if controller.is_active]
        # As the original prefers: default ones, active ones, those that move few joints besides.
        candidates.sort(
            key=lambda c: (not c.is_default, not c.is_active, len(set(c.joints) - set(joints)), len(c.joints) * -1)
        )
        chosen: list[Controller] = []
        missing = set(joints)
        while missing:
            best = max(candidates, key=lambda c: len(missing & set(c.joints)), default=None)
            if best is None or not missing & set(best.joints):
                self._report_missing(joints, missing, known)
                return None
            chosen.append(best)
            missing -= set(best.joints)
            candidates.remove(best)
        if self._manages and not await self._source.activate(chosen):
            return None
        return chosen

    def _report_missing(self, joints: Sequence[str], missing: set[str], known: Sequence[Controller]) -> None:
        lines = [f"controller '{c.name}' controls joints: {', '.join(c.joints) or 'none'}" for c in known]
        self._node.log.error(
            "Unable to identify any set of controllers that can actuate the specified joints: "
            f"[ {' '.join(joints)} ]; nothing moves {', '.join(sorted(missing))}"
        )
        self._node.log.error("Known controllers and their joints:\n" + ("\n".join(lines) or "none"))

    # -- from where

    async def _starts_here(self, path: JointPath) -> bool:
        """True if the path starts where the robot is, within the tolerance; 0 means that it is not compared."""
        tolerance = self.settings.allowed_start_tolerance
        if tolerance == 0.0 and not self._joint_tolerances:
            return True
        if not await self._monitor.wait_since(self._node.clock.now_ns(), _STATE_WAIT_S):
            missing = ", ".join(self._monitor.stale(self._node.clock.now_ns() - round(_STATE_WAIT_S * NS_PER_S)))
            self._node.log.warn(
                "Failed to validate trajectory: couldn't receive full current joint state within 1s; nothing new of "
                f"{missing or 'any joint'}"
            )
            return False
        present = self._monitor.positions()
        for name, expected in zip(path.joints, path.positions[0], strict=True):
            if not self._model.has_joint(name):
                self._node.log.error(f"Unknown joint in trajectory: {name}")
                return False
            limit = self._joint_tolerances.get(name, tolerance)
            number = self._model.variable_index(name)
            current = float(present[number])
            difference = abs(current - float(expected))
            if not self._model.is_bounded[number] and self._model.joint(name).type == "continuous":
                difference = abs((difference + np.pi) % (2.0 * np.pi) - np.pi)
            if limit != 0.0 and difference > limit:
                self._node.log.error(
                    f"Invalid Trajectory: start point deviates from current robot state more than {limit:g}: "
                    f"joint '{name}': expected: {float(expected):g}, current: {current:g}"
                )
                return False
        return True

    # -- for how long

    async def _run(self, path: JointPath, controllers: Sequence[Controller]) -> Outcome:
        settings = self.settings
        if settings.execution_velocity_scaling != 1.0:
            path = path.scaled(settings.execution_velocity_scaling)
        self._node.log.debug("Starting trajectory execution ...")
        parts = [(controller, path.select(controller.joints)) for controller in controllers]
        runs = [asyncio.create_task(controller.execute(part)) for controller, part in parts]
        expected_s = path.duration_s
        limit_s = expected_s * settings.allowed_execution_duration_scaling + settings.allowed_goal_duration_margin
        try:
            outcome = await self._await_all(runs, controllers, limit_s)
        except asyncio.CancelledError:
            self._node.log.info("Completed trajectory execution with status PREEMPTED ...")
            raise
        finally:
            for run in runs:
                run.cancel()
            await asyncio.gather(*runs, return_exceptions=True)
        if outcome is Outcome.SUCCEEDED and settings.wait_for_trajectory_completion:
            await self._wait_still(path.joints)
        self._node.log.info(f"Completed trajectory execution with status {outcome.value} ...")
        return outcome

    async def _await_all(
        self, runs: Sequence["asyncio.Task[Outcome]"], controllers: Sequence[Controller], limit_s: float
    ) -> Outcome:
        pending = set(runs)
        watch = asyncio.create_task(self._node.clock.sleep(limit_s))
        try:
            while pending:
                waiting = {*pending, watch} if self.settings.execution_duration_monitoring else set(pending)
                done, _ = await asyncio.wait(waiting, return_when=asyncio.FIRST_COMPLETED)
                pending -= done
                for controller, run in zip(controllers, runs, strict=True):
                    if run in done and run.result() is not Outcome.SUCCEEDED:
                        status = run.result()
                        self._node.log.warn(f"Controller handle {controller.name} reports status {status.value}")
                        return status
                if watch in done and pending:
                    self._node.log.error(
                        "Controller is taking too long to execute trajectory (the expected upper bound for the "
                        f"trajectory execution was {limit_s:f} seconds). Stopping trajectory."
                    )
                    return Outcome.TIMED_OUT
        finally:
            watch.cancel()
        return Outcome.SUCCEEDED

    async def _wait_still(self, joints: Sequence[str]) -> None:
        """Wait until the joints rest, at most a second."""
        indices = [self._model.variable_index(name) for name in joints if self._model.has_joint(name)]
        clock = self._node.clock
        start_ns = clock.now_ns()
        before = self._monitor.positions()[indices]
        while clock.now_ns() - start_ns < _STOP_WAIT_S * NS_PER_S:
            since_ns = clock.now_ns()
            await clock.sleep(_LOOK_S)
            if not await self._monitor.wait_since(since_ns, _STOP_WAIT_S):
                return
            now = self._monitor.positions()[indices]
            if np.all(np.abs(now - before) < _STILL):
                return
            before = now
