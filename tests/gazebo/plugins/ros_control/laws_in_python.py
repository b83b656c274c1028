"""Laws of ros_control in Python, at every step: the reference for the C++ laws."""

import math
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

from trundle.gazebo.plugins.ros_control.trajectory_goal import JointPath, PathSegment
from trundle.gazebo.plugins.ros_control.transmissions import Interface
from trundle.robots.model import JointType
from trundle.sim.control import DifferentialDrive, SpeedLimit, WheelOdometry
from trundle.sim.simulation import JointHandle, Simulation

Event: TypeAlias = tuple[int, int, float]
_SETTLING_NS = 200_000_000


@dataclass
class PythonPid:
    """PID of control_toolbox."""

    p: float = 0.0
    i: float = 0.0
    d: float = 0.0
    i_clamp: float = 0.0
    antiwindup: bool = False
    _integral: float = 0.0
    _last: float = 0.0

    def reset(self) -> None:
        self._integral = self._last = 0.0

    def command(self, error: float, dt: float, *, slope: float | None = None) -> float:
        if slope is None:
            slope = (error - self._last) / dt
        self._last = error
        self._integral += error * dt
        if self.antiwindup and self.i:
            limit = abs(self.i_clamp / self.i)
            self._integral = min(max(self._integral, -limit), limit)
        contribution = min(max(self.i * self._integral, -self.i_clamp), self.i_clamp)
        return self.p * error + contribution + self.d * slope


class PythonJoint:
    """Joint of gazebo_ros_control's default hardware."""

    def __init__(self, handle: JointHandle, interface: Interface, pid: PythonPid | None, *, lag_s: float) -> None:
        self.handle, self.interface, self.pid, self.lag_s = handle, interface, pid, lag_s
        self.command = self.position = self.velocity = self.effort = 0.0
        self._is_at_rest = True
        axis = handle.joint.axis
        assert axis is not None
        self.lower, self.upper, self._max_effort, self._max_speed = axis.lower, axis.upper, axis.effort, axis.velocity

    def read(self) -> None:
        self.position, self.velocity, self.effort = self.handle.position, self.handle.velocity, self.handle.effort

    def error(self, target: float) -> float:
        is_revolute = self.handle.joint.type is JointType.REVOLUTE
        difference = target - self.position
        is_continuous = is_revolute and math.isinf(self.upper) and math.isinf(self.lower)
        return math.remainder(difference, math.tau) if is_continuous else difference

    def shortest_error(self, target: float) -> float:
        difference = target - self.position
        return difference if self.handle.joint.type is JointType.PRISMATIC else math.remainder(difference, math.tau)

    @property
    def settling_ns(self) -> int:
        return _SETTLING_NS if self.interface == "PositionJointInterface" and self.pid is None else 0

    def stop(self) -> None:
        self._is_at_rest = True
        if self.interface != "PositionJointInterface":
            self.command = 0.0
        if self.pid is not None:
            self.pid.reset()

    def start(self) -> None:
        self._is_at_rest = False
        self.command = self.position if self.interface == "PositionJointInterface" else 0.0

    def write(self, dt: float) -> None:
        match self.interface:
            case "EffortJointInterface":
                self.handle.command_effort(self.command, hardware=True)
            case "VelocityJointInterface":
                target = min(max(self.command, -self._max_speed), self._max_speed)
                if self.pid is not None:
                    self.handle.command_effort(self.pid.command(target - self.velocity, dt), hardware=True)
                else:
                    self.handle.command_velocity(target, max_effort=self._max_effort, hardware=True)
            case _:
                self._write_position(dt)

    def _write_position(self, dt: float) -> None:
        if self._is_at_rest and self.velocity == 0.0 and self.error(self.command) != 0.0:
            self.command = self.position
        error = self.error(min(max(self.command, self.lower), self.upper))
        if self.pid is not None:
            self.handle.command_effort(self.pid.command(error, dt), hardware=True)
            return
        speed = error / self.lag_s
        self.handle.drive_kinematically(min(max(speed, -self._max_speed), self._max_speed), hardware=True)


@dataclass
class PythonLoop:
    """PID loop around one joint."""

    joint: PythonJoint
    pid: PythonPid
    of_speed: bool
    target: float = 0.0

    def start(self, time_ns: int) -> None:
        del time_ns
        self.joint.start()
        self.pid.reset()
        self.target = 0.0 if self.of_speed else self.joint.position

    def update(self, time_ns: int, dt: float) -> None:
        del time_ns
        if self.of_speed:
            error = self.target - self.joint.velocity
        else:
            self.target = min(max(self.target, self.joint.lower), self.joint.upper)
            error = self.joint.error(self.target)
        self.joint.command = self.pid.command(error, dt)


class PythonTrajectory:
    """Paths of a joint_trajectory_controller."""

    def __init__(self, joints: Sequence[PythonJoint], pids: Sequence[PythonPid], forward: Sequence[float]) -> None:
        self._joints, self._pids, self._forward = joints, pids, forward
        self.paths: list[JointPath] = []
        self.watches, self.goal = False, 0
        self.desired = [(0.0, 0.0, 0.0)] * len(joints)
        self.time_ns = 0
        self._arrived: set[int] = set()
        self._event: Event | None = None

    def begin_goal(self, goal: int) -> None:
        self.goal = goal
        self._arrived.clear()

    def take_event(self) -> Event | None:
        event, self._event = self._event, None
        return event

    def update(self, time_ns: int, dt: float) -> None:
        self.time_ns = time_ns
        segments = [path.at(time_ns) for path in self.paths]
        self.desired = [segment.segment.sample(time_ns) for segment in segments]
        if self.watches:
            self._event = self._check(segments)
            self.watches = self._event is None
        for number, (joint, (position, velocity, _)) in enumerate(zip(self._joints, self.desired, strict=True)):
            if not self._pids:
                joint.command = position
                continue
            slope = velocity - joint.velocity
            command = self._pids[number].command(joint.shortest_error(position), dt, slope=slope)
            joint.command = command + self._forward[number] * velocity

    def _check(self, segments: Sequence[PathSegment]) -> Event | None:
        for number, (joint, path, segment) in enumerate(zip(self._joints, self.paths, segments, strict=True)):
            if segment.goal != self.goal:
                continue
            position, velocity, _ = self.desired[number]
            errors = joint.shortest_error(position), velocity - joint.velocity
            if self.time_ns < segment.segment.end_ns:
                if not segment.tolerances.path.allows(*errors):
                    return -4, number, errors[0]
            elif segment is path.segments[-1]:
                if segment.tolerances.goal.allows(*errors):
                    self._arrived.add(number)
                elif self.time_ns >= segment.segment.end_ns + segment.tolerances.time_ns + joint.settling_ns:
                    return -5, number, errors[0]
        return (0, 0, 0.0) if len(self._arrived) == len(self._joints) else None


class PythonDiffDrive:
    """Wheel speeds and odometry of diff_drive_controller."""

    def __init__(
        self,
        left: Sequence[PythonJoint],
        right: Sequence[PythonJoint],
        *,
        wheel_radius: float,
        separation: float,
        radii: tuple[float, float],
        limits: Sequence[tuple[float, ...]],
        timeout_ns: int,
        open_loop: bool,
        window: int,
    ) -> None:
        self._left, self._right, self._radii = left, right, radii
        self._drive = DifferentialDrive(wheel_radius=wheel_radius, separation=separation)
        names = SpeedLimit.__struct_fields__
        self._limits = [SpeedLimit(**dict(zip(names, segment, strict=True))) for segment in limits]
        self._timeout_ns, self._open_loop = timeout_ns, open_loop
        self._odometry = WheelOdometry(self._drive)
        self._history = [(0.0, 0.0), (0.0, 0.0)]
        self._speeds: deque[tuple[float, float]] = deque(maxlen=window)

    def start(self) -> None:
        for joint in (*self._left, *self._right):
            joint.start()
        self._wheel_angles = self._mean_angles()
        self._command: tuple[int, float, float] | None = None

    def set_command(self, stamp_ns: int, linear: float, angular: float) -> None:
        self._command = stamp_ns, linear, angular

    @property
    def pose(self) -> tuple[float, float, float]:
        return self._odometry.x, self._odometry.y, self._odometry.yaw

    @property
    def speeds(self) -> list[tuple[float, float]]:
        return list(self._speeds)

    @property
    def limited(self) -> tuple[float, float]:
        return self._history[0][0], self._history[1][0]

    def update(self, time_ns: int, dt: float) -> None:
        self._update_odometry(dt)
        is_timed_out = self._command is None or time_ns - self._command[0] > self._timeout_ns
        targets = (0.0, 0.0) if is_timed_out or self._command is None else self._command[1:]
        for index, target in enumerate(targets):
            last, previous = self._history[index]
            self._history[index] = (self._limits[index].limit(target, last, previous, dt), last)
        (linear, _), (angular, _) = self._history
        half = angular * self._drive.separation / 2
        for joints, speed, radius in zip(
            (self._left, self._right), (linear - half, linear + half), self._radii, strict=True
        ):
            for joint in joints:
                joint.command = speed / radius

    def _mean_angles(self) -> tuple[float, float]:
        left, right = (sum(joint.position for joint in side) / len(side) for side in (self._left, self._right))
        return left, right

    def _update_odometry(self, dt: float) -> None:
        if self._open_loop:
            (linear, _), (angular, _) = self._history
            half = angular * self._drive.separation / 2
            left, right = (linear - half) * dt, (linear + half) * dt
        else:
            angles = self._mean_angles()
            left, right = (
                (new - old) * radius for new, old, radius in zip(angles, self._wheel_angles, self._radii, strict=True)
            )
            self._wheel_angles = angles
        radius = self._drive.wheel_radius
        distance, turn = self._odometry.update(left / radius, right / radius)
        self._speeds.append((distance / dt, turn / dt))


class PythonGripper:
    """Finger of a gripper_action_controller."""

    def __init__(
        self, joint: PythonJoint, pid: PythonPid | None, *, tolerance: float, min_speed: float, stall_ns: int
    ) -> None:
        self._joint, self._pid = joint, pid
        self._tolerance, self._min_speed, self._stall_ns = tolerance, min_speed, stall_ns
        self.watches = False
        self._event: bool | None = None

    def start(self, time_ns: int) -> None:
        self._joint.start()
        self.begin(self._joint.position, 0.0, time_ns)

    def begin(self, target: float, max_effort: float, time_ns: int) -> None:
        self._target, self._max_effort, self._moved_ns = target, max_effort, time_ns

    def take_event(self) -> bool | None:
        event, self._event = self._event, None
        return event

    def update(self, time_ns: int, dt: float) -> None:
        joint, limit = self._joint, self._max_effort
        error = joint.error(self._target)
        if self._pid is None:
            joint.command = self._target
        else:
            effort = self._pid.command(error, dt, slope=-joint.velocity)
            joint.command = min(max(effort, -limit), limit) if limit > 0.0 else effort
        if abs(joint.velocity) > self._min_speed or time_ns < self._moved_ns:
            self._moved_ns = time_ns
        if not self.watches:
            return
        if abs(error) < self._tolerance:
            self._event = True
        elif time_ns - self._moved_ns > self._stall_ns:
            self._event = False
        self.watches = self._event is None


PythonLaw: TypeAlias = PythonLoop | PythonTrajectory | PythonDiffDrive | PythonGripper


class PythonServo:
    """Hook that reads, updates and writes at every step."""

    def __init__(self, joints: Sequence[PythonJoint], laws: Sequence[PythonLaw]) -> None:
        self._joints, self._laws, self._last_ns = joints, laws, 0

    def before_step(self, sim: Simulation) -> None:
        dt = (sim.time_ns - self._last_ns) / 1e9
        self._last_ns = sim.time_ns
        if dt <= 0.0:
            return
        for joint in self._joints:
            joint.read()
        for law in self._laws:
            law.update(sim.time_ns, dt)
        for joint in self._joints:
            joint.write(dt)
