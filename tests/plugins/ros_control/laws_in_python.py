"""Laws of ros_control as rules in Python, at every step, to which the C++ is compared."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

from trundle.model import JointType
from trundle.plugins.ros_control.trajectory_goal import JointPath, PathSegment
from trundle.plugins.ros_control.transmissions import Interface
from trundle.simulation import JointHandle, Simulation

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
            most = abs(self.i_clamp / self.i)
            self._integral = min(max(self._integral, -most), most)
        contribution = min(max(self.i * self._integral, -self.i_clamp), self.i_clamp)
        return self.p * error + contribution + self.d * slope


class PythonJoint:
    """Joint of gazebo_ros_control's default hardware."""

    def __init__(self, handle: JointHandle, interface: Interface, pid: PythonPid | None, *, lag_s: float) -> None:
        self.handle, self.interface, self.pid, self.lag_s = handle, interface, pid, lag_s
        self.command = self.position = self.velocity = 0.0
        self._is_at_rest = True
        axis = handle.joint.axis
        assert axis is not None
        self.lower, self.upper, self._most_effort, self._most_speed = axis.lower, axis.upper, axis.effort, axis.velocity

    def read(self) -> None:
        self.position, self.velocity = self.handle.position, self.handle.velocity

    def error(self, wanted: float) -> float:
        is_revolute = self.handle.joint.type is JointType.REVOLUTE
        way = wanted - self.position
        is_continuous = is_revolute and math.isinf(self.upper) and math.isinf(self.lower)
        return math.remainder(way, math.tau) if is_continuous else way

    def shortest_error(self, wanted: float) -> float:
        way = wanted - self.position
        return way if self.handle.joint.type is JointType.PRISMATIC else math.remainder(way, math.tau)

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
                wanted = min(max(self.command, -self._most_speed), self._most_speed)
                if self.pid is not None:
                    self.handle.command_effort(self.pid.command(wanted - self.velocity, dt), hardware=True)
                else:
                    self.handle.command_velocity(wanted, max_effort=self._most_effort, hardware=True)
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
        self.handle.drive_kinematically(min(max(speed, -self._most_speed), self._most_speed), hardware=True)


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
        self.desired = [each.segment.sample(time_ns) for each in segments]
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
        for number, (joint, path, on) in enumerate(zip(self._joints, self.paths, segments, strict=True)):
            if on.goal != self.goal:
                continue
            position, velocity, _ = self.desired[number]
            errors = joint.shortest_error(position), velocity - joint.velocity
            if self.time_ns < on.segment.end_ns:
                if not on.tolerances.path.allows(*errors):
                    return -4, number, errors[0]
            elif on is path.segments[-1]:
                if on.tolerances.goal.allows(*errors):
                    self._arrived.add(number)
                elif self.time_ns >= on.segment.end_ns + on.tolerances.time_ns + joint.settling_ns:
                    return -5, number, errors[0]
        return (0, 0, 0.0) if len(self._arrived) == len(self._joints) else None


class PythonServo:
    """Hook that reads, updates and writes at every step."""

    def __init__(self, joints: Sequence[PythonJoint], laws: Sequence[PythonLoop | PythonTrajectory]) -> None:
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
