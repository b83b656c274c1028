"""Laws in C++ within the step give the same bytes as laws in Python at every step."""

import math
import random
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
import pytest
from tests.gazebo.plugins.ros_control.laws_in_python import (
    PythonGripper,
    PythonJoint,
    PythonLoop,
    PythonPid,
    PythonServo,
    PythonTrajectory,
)

import trundle
from trundle.gazebo.plugins.ros_control.hardware import JointHardware
from trundle.gazebo.plugins.ros_control.tolerances import JointTolerances, StateTolerance
from trundle.gazebo.plugins.ros_control.trajectory_goal import JointPath, PathSegment
from trundle.gazebo.plugins.ros_control.transmissions import INTERFACES, Interface
from trundle.sim.control import GripperLaw, JointSegment, JointState, PidLoop, Servo, ToolboxPid, TrajectoryLaw
from trundle.sim.physics import SimulationUnstableError
from trundle.sim.simulation import Simulation
from trundle.spatial import Wrench

_Event: TypeAlias = tuple[int, object, list[tuple[float, ...]]]
"""Time [ns], event, and position, velocity and effort of each joint."""
_LINK = """<link name="{0}"><pose>{1} 0 0 0 0 0</pose><inertial><mass>1</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy>
<izz>0.1</izz></inertia></inertial></link>"""
_KINDS = ("revolute", "revolute", "prismatic", "revolute", "continuous", "revolute")
_LIMITS = (
    "<lower>-2</lower><upper>2</upper>",
    "<lower>-2</lower><upper>2</upper><effort>30</effort><velocity>4</velocity>",
    "<lower>-0.5</lower><upper>0.5</upper><effort>60</effort>",
    "<velocity>3</velocity>",
    "",
    "<effort>5</effort><velocity>2</velocity>",
)


def _arm(folder: Path) -> Simulation:
    """Chain of six joints that hangs from the world."""
    parts = "".join(
        f"""{_LINK.format(f"l{i}", 0.2 * i)}<joint name="j{i}" type="{kind}"><parent>{f"l{i - 1}" if i else "world"}
        </parent><child>l{i}</child><axis><xyz>0 {1 - i % 2} {i % 2}</xyz><limit>{limit}</limit>
        <dynamics><damping>0.3</damping></dynamics></axis></joint>"""
        for i, (kind, limit) in enumerate(zip(_KINDS, _LIMITS, strict=True))
    )
    file = folder / "w.sdf"
    file.write_text(f'<sdf version="1.7"><world name="w"><model name="m">{parts}</model></world></sdf>')
    return trundle.load(str(file))


class _InStep:
    """Hook whose servo acts in C++, as ros_control's plugin."""

    def __init__(self, servo: Servo, law: Any, joints: Sequence[Any]) -> None:
        self._servo, self._law, self._joints = servo, law, joints
        self.events: list[_Event] = []
        self.calls = 0

    def before_step(self, sim: Simulation) -> None:
        self.calls += 1
        dt = self._servo.read(sim.time_ns, sim.step_ns)
        if dt > 0.0:
            self._servo.update(dt)
            self._servo.write(dt)
        self.finish_stride()

    def step_action(self) -> tuple[Servo, float]:
        return self._servo, math.inf

    def finish_stride(self) -> None:
        event = self._law.take_event()
        if event is not None:
            self.events.append((self._law.time_ns, event, _states(self._joints)))


class _Events:
    """Hook that records the events of the Python law."""

    def __init__(self, law: Any, joints: Sequence[Any]) -> None:
        self._law, self._joints = law, joints
        self.events: list[_Event] = []

    def before_step(self, sim: Simulation) -> None:
        event = self._law.take_event()
        if event is not None:
            self.events.append((sim.time_ns, event, _states(self._joints)))


def _states(joints: Sequence[Any]) -> list[tuple[float, ...]]:
    return [(joint.position, joint.velocity, joint.effort) for joint in joints]


def _add_hooks(
    sim: Simulation, joints: Sequence[Any], laws: Sequence[Any], watched: Any, *, in_step: bool
) -> list[_Event]:
    """Run laws in C++ or in Python; return the list that receives the watched law's events."""
    if in_step:
        servo = Servo(joints)
        servo.longest_ns = sim.step_ns
        servo.set_laws(laws)
        hook = _InStep(servo, watched, joints)
        sim.add_hook(hook)
        return hook.events
    events = _Events(watched, joints)
    sim.add_hook(PythonServo(joints, laws))
    sim.add_hook(events)
    return events.events


class _OtherPlugin:
    """Plugin that commands joints 0 and 5 directly, every 13 ms."""

    period_ns = 13_000_000

    def __init__(self, seed: int) -> None:
        self._random = random.Random(seed)

    def before_step(self, sim: Simulation) -> None:
        for name in ("j0", "j5"):
            value = self._random.gauss(0.0, 0.5)
            if self._random.random() < 0.5:
                sim["m"].joint(name).command_velocity(value, max_effort=2.0)
            else:
                sim["m"].joint(name).command_effort(value)


class _ControlledArm:
    """Arm with joints 0 to 2 on a trajectory, 3 and 4 under PID loops, and 5 at a constant command."""

    def __init__(self, folder: Path, random_: random.Random, *, in_step: bool, other: int = 0) -> None:
        """Create the arm; another plugin acts before its laws (1), after them (2) or not at all (0)."""
        self.sim = _arm(folder)
        if other == 1:
            self.sim.add_hook(_OtherPlugin(1), period_ns=_OtherPlugin.period_ns)
        pid_class, joint_class, loop_class, law_class = (
            (ToolboxPid, JointHardware, PidLoop, TrajectoryLaw)
            if in_step
            else (PythonPid, PythonJoint, PythonLoop, PythonTrajectory)
        )

        def gains(*, of_speed: bool = False) -> Any:
            p, i, d = random_.choice((5.0, 20.0)), random_.choice((0.0, 4.0)), random_.choice((0.2, 1.0))
            clamp, antiwindup = random_.choice((0.0, 3.0)), random_.random() < 0.5
            return pid_class(
                p=0.1 * p if of_speed else p, i=i, d=0.0 if of_speed else d, i_clamp=clamp, antiwindup=antiwindup
            )

        def hardware(number: int, interface: Interface) -> Any:
            of_speed = interface == "VelocityJointInterface"
            pid_gains = gains(of_speed=of_speed) if interface != INTERFACES[0] and random_.random() < 0.5 else None
            return joint_class(self.sim["m"].joint(f"j{number}"), interface, pid_gains, lag_s=0.005)

        interface = random_.choice(INTERFACES)
        self.joints = [hardware(number, interface) for number in range(3)]
        self.joints += [hardware(3, INTERFACES[0]), hardware(4, random_.choice((INTERFACES[0], INTERFACES[2])))]
        self.joints.append(hardware(5, random_.choice(INTERFACES)))
        for joint in self.joints:
            joint.read()
            joint.start()
        by_speed = interface == "VelocityJointInterface"
        pids = [] if interface == "PositionJointInterface" else [gains(of_speed=by_speed) for _ in range(3)]
        speeds = [random_.random() < 0.5 for _ in range(2)]
        self.loops: list[Any] = [
            loop_class(joint, gains(of_speed=speed or joint.interface == "VelocityJointInterface"), speed)
            for joint, speed in zip(self.joints[3:5], speeds, strict=True)
        ]
        for loop in self.loops:
            loop.start(0)
        forward = [random_.choice((0.0, 0.2)) for _ in range(3)]
        self.law: Any = law_class(self.joints[:3], pids, forward)
        laws: list[Any] = [self.law, *self.loops]
        self.events = _add_hooks(self.sim, self.joints, laws, self.law, in_step=in_step)
        if other == 2:
            self.sim.add_hook(_OtherPlugin(2), period_ns=_OtherPlugin.period_ns)

    @property
    def hook(self) -> "_InStep":
        """Hook of an arm with laws in C++."""
        return next(hook for hook in self.sim.hooks if isinstance(hook, _InStep))

    def command(self, random_: random.Random, goal: int) -> None:
        """Set new paths and targets, equal for equal random states."""
        now_ns = self.sim.time_ns
        paths = [_path(random_, joint.position, now_ns, goal) for joint in self.joints[:3]]
        if isinstance(self.law, PythonTrajectory):
            self.law.paths = paths
        else:
            self.law.set_paths([path.rows() for path in paths])
        self.law.begin_goal(goal)
        self.law.watches = True
        for loop in self.loops:
            loop.target = random_.gauss(0.0, 1.5)
        self.joints[5].command = random_.choice((0.0, random_.gauss(0.0, 1.0)))
        if random_.random() < 0.3:
            self.sim["m"].joint("j5").command_effort(random_.gauss(0.0, 1.0), duration_s=0.03)

    def state_bytes(self) -> bytes:
        """Return the bytes of all state that commands and steps write."""
        saved = self.sim.save().engine
        data, motors = saved.data, saved.motors
        arrays = (data.qpos, data.qvel, data.ctrl, data.qfrc_applied, data.qfrc_actuator, data.userdata)
        return np.concatenate([*arrays, motors.max_efforts, motors.rates, motors.states.ravel()]).tobytes()


def _path(random_: random.Random, position: float, now_ns: int, goal: int) -> JointPath:
    """Return a random path of linear, cubic or quintic segments, with tolerances that may end the goal."""
    times = [now_ns + random_.choice((0, 7_500_000))]
    times += [times[0] + ms * 1_000_000 + random_.randrange(1000) for ms in (40, 90, 150)]
    degree = random_.randrange(3)
    states = [
        JointState(
            position if k == 0 else position + random_.gauss(0.0, 0.2),
            *[random_.gauss(0.0, 0.5) for _ in range(degree)],
        )
        for k in range(4)
    ]
    tolerances = JointTolerances(
        StateTolerance(random_.choice((0.0, 0.3)), random_.choice((0.0, 8.0))),
        StateTolerance(random_.choice((0.05, 1.0, 10.0)), random_.choice((0.0, 10.0))),
        random_.choice((0, 20_000_000)),
    )
    ends = zip(pairwise(times), pairwise(states), strict=True)
    return JointPath([PathSegment(JointSegment.between(a, x, b, y), goal, tolerances) for (a, b), (x, y) in ends])


@pytest.mark.parametrize("seed", range(8))
def test_random_trajectories_give_the_same_bytes_as_in_python(tmp_path: Path, seed: int) -> None:
    """The C++ acts within strides, which events end; Python acts at every step, before or after another plugin."""
    cpp, python = (
        _ControlledArm(tmp_path, random.Random(seed), in_step=in_step, other=seed % 3) for in_step in (True, False)
    )
    for goal in range(1, 9):
        for arm in (cpp, python):
            arm.command(random.Random(f"{seed} {goal}"), goal)
        for steps in (1, 2 + goal, 70, 61, 37):
            cpp.sim.step(steps)
            python.sim.step(steps)
            assert cpp.state_bytes() == python.state_bytes()
            assert [joint.command for joint in cpp.joints] == [joint.command for joint in python.joints]
            assert cpp.law.desired == python.law.desired
    assert cpp.events == python.events
    assert cpp.hook.calls < 0.15 * cpp.sim.steps


@pytest.mark.parametrize("interface", ["EffortJointInterface", "PositionJointInterface"])
def test_a_gripper_arrives_and_stalls_in_the_same_states_as_in_python(tmp_path: Path, interface: Any) -> None:
    """Joint 2 closes on its stop; the result has the position and effort of that step."""
    results: list[list[object]] = []
    for in_step in (True, False):
        sim = _arm(tmp_path)
        joint, law, pid = (
            (JointHardware, GripperLaw, ToolboxPid) if in_step else (PythonJoint, PythonGripper, PythonPid)
        )
        finger: Any = joint(sim["m"].joint("j2"), interface, None, lag_s=0.005)
        finger.read()
        gains: Any = pid(p=200.0, d=30.0) if interface == "EffortJointInterface" else None
        grip: Any = law(finger, gains, tolerance=0.01, min_speed=0.001, stall_ns=50_000_000)
        grip.start(0)
        events = _add_hooks(sim, [finger], [grip], grip, in_step=in_step)
        for target, max_effort in ((0.2, 0.0), (3.0, 20.0), (-0.1, 0.0), (-3.0, 0.0)):
            grip.begin(target, max_effort, sim.time_ns)
            grip.watches = True
            sim.step(700)
        results.append([*events, sim.save().engine.data.qpos.tobytes()])

    assert results[0] == results[1]
    assert len(results[0]) > 3


def test_a_goal_that_settles_ends_the_stride(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    arm = _ControlledArm(tmp_path, random.Random(3), in_step=True)
    arm.command(random.Random(1), 1)
    strides: list[int] = []
    step = arm.sim.engine.step

    def counted_step(count: int, recorders: Any) -> int:
        steps_taken = step(count, recorders)
        strides.append(steps_taken)
        return steps_taken

    monkeypatch.setattr(arm.sim.engine, "step", counted_step)
    arm.sim.step(400)
    (time_ns, _, _), *_ = arm.events

    assert sum(strides) == 400
    assert time_ns == (strides[0] - 1) * arm.sim.step_ns  # before the last step of the first stride


def test_an_unstable_stride_restores_joints_and_laws(tmp_path: Path) -> None:
    """The run continues from the last stable state."""
    arm, other = (_ControlledArm(tmp_path, random.Random(5), in_step=True) for _ in range(2))
    for either in (arm, other):
        either.command(random.Random(2), 1)
        either.sim.step(60)
    before = arm.state_bytes()
    arm.sim["m"].link("l5").apply_wrench(Wrench(force=(1e12, 0.0, 0.0)))
    with pytest.raises(SimulationUnstableError):
        arm.sim.step(50)
    assert arm.state_bytes() != before  # the stride's first action remains
    assert arm.law.time_ns == arm.sim.time_ns
    arm.sim["m"].link("l5").apply_wrench(Wrench())
    for either in (arm, other):
        either.sim.step(100)

    assert arm.state_bytes() == other.state_bytes()
    assert arm.law.desired == other.law.desired


def test_checkpoints_restore_all_state(tmp_path: Path) -> None:
    arm = _ControlledArm(tmp_path, random.Random(7), in_step=True)
    arm.command(random.Random(3), 1)
    arm.sim.step(30)
    saved = arm.sim.save()
    restores = [item.checkpoint() for item in (*arm.joints, *arm.loops, arm.law)]
    arm.sim.step(90)
    after = arm.state_bytes()
    arm.command(random.Random(4), 2)
    arm.sim.step(90)
    arm.sim.restore(saved)
    for restore in restores:
        restore()
    arm.hook._servo.restart(arm.sim.time_ns - arm.sim.step_ns)
    arm.sim.step(90)

    assert arm.state_bytes() == after
