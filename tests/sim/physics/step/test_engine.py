"""Stepping, commanding, saving and restoring the state of a world."""

import math
from pathlib import Path

import numpy as np
import pytest

from trundle.base.diagnostics import Diagnostics, Source, UsageError
from trundle.robots.model import (
    Collision,
    Inertial,
    Joint,
    JointAxis,
    JointType,
    Link,
    Model,
    PhysicsSettings,
    Plane,
    Sphere,
    World,
)
from trundle.sim.physics import SimulationUnstableError
from trundle.sim.simulation import Simulation, Snapshot
from trundle.spatial import Pose, Wrench

AT = Source("inline.sdf", 1)
INERTIA = 0.01
WEIGHTLESS = PhysicsSettings(gravity=(0.0, 0.0, 0.0))


def wheel(axis: JointAxis | None = None, *, damping: float = 0.0) -> Simulation:
    """One wheel of 0.01 kg·m² on a hinge in the world, balanced."""
    axis = axis or JointAxis(direction=(0.0, 0.0, 1.0), damping=damping)
    rim = Link(name="rim", at=AT, inertial=Inertial(mass=1.0, moments=(INERTIA, INERTIA, INERTIA)))
    joint = Joint(name="hub", type=JointType.REVOLUTE, parent="world", child="rim", at=AT, axis=axis)
    model = Model(name="wheel", at=AT, links=(rim,), joints=(joint,))
    return Simulation(World(name="w", at=AT, models=(model,)), Diagnostics(strict=True))


def tumbler() -> Simulation:
    """Two links and a hinge flying freely, their centres of mass away from their frames."""
    body = Inertial(mass=2.0, link_from_com=Pose((0.1, -0.2, 0.05)), moments=(0.02, 0.03, 0.04))
    arm = Inertial(mass=0.5, link_from_com=Pose((0.0, 0.3, 0.0)), moments=(0.01, 0.002, 0.01))
    links = (
        Link(name="arm", at=AT, model_from_link=Pose((0.5, 0.0, 0.2)), inertial=arm),
        Link(name="body", at=AT, inertial=body),
    )
    axis = JointAxis(direction=(0.6, 0.0, 0.8))
    joint = Joint(name="elbow", type=JointType.REVOLUTE, parent="body", child="arm", at=AT, axis=axis)
    model = Model(name="t", at=AT, links=links, joints=(joint,))
    return Simulation(World(name="w", at=AT, models=(model,), physics=WEIGHTLESS), Diagnostics(strict=True))


def same(a: Snapshot, b: Snapshot) -> bool:
    """Return True if two snapshots agree to the last bit."""
    fields = ("poses", "twists", "joint_positions", "joint_velocities", "joint_efforts")
    return a.time_ns == b.time_ns and all(getattr(a, f).tobytes() == getattr(b, f).tobytes() for f in fields)


def spin_up(sim: Simulation) -> None:
    sim["t"].link("body").apply_wrench(Wrench(force=(1.0, 2.0, 3.0), torque=(0.3, -0.2, 0.1)))
    sim["t"].joint("elbow").command_effort(0.02)


def test_an_effort_accelerates_until_the_next_command() -> None:
    sim = wheel()
    hub = sim["wheel"].joint("hub")
    hub.command_effort(0.05)
    sim.run(0.4)
    assert hub.velocity == pytest.approx(0.05 / INERTIA * 0.4, rel=1e-6)
    assert hub.effort == pytest.approx(0.05)
    hub.command_effort(0.0)
    speed = hub.velocity
    sim.run(0.4)
    assert hub.velocity == pytest.approx(speed, rel=1e-9)


def test_a_motor_reaches_its_speed_as_fast_as_its_effort_allows() -> None:
    sim = wheel()
    hub = sim["wheel"].joint("hub")
    hub.command_velocity(4.0, max_effort=0.1)
    sim.run(0.2)
    # 0.1 N·m on 0.01 kg·m²: 10 rad/s², so 2 rad/s after 0.2 s and 4 after 0.4 s.
    assert hub.velocity == pytest.approx(2.0, rel=1e-3)
    assert hub.effort == pytest.approx(0.1)
    sim.run(0.3)
    assert hub.velocity == pytest.approx(4.0, rel=1e-4)
    assert abs(hub.effort) < 1e-3


def test_a_motor_too_weak_for_the_load_stalls() -> None:
    sim = wheel(damping=0.05)
    hub = sim["wheel"].joint("hub")
    hub.command_velocity(10.0, max_effort=0.1)
    sim.run(3.0)
    # Damping takes the whole 0.1 N·m at 2 rad/s.
    assert hub.velocity == pytest.approx(2.0, rel=1e-3)


def test_the_joints_effort_limit_applies_to_motors_and_efforts() -> None:
    axis = JointAxis(direction=(0.0, 0.0, 1.0), effort=0.02)
    sim = wheel(axis)
    sim["wheel"].joint("hub").command_velocity(100.0)
    sim.run(0.5)
    assert sim["wheel"].joint("hub").velocity == pytest.approx(0.02 / INERTIA * 0.5, rel=1e-3)


def test_a_position_command_moves_a_joint_to_its_target_and_holds_it() -> None:
    sim = wheel()
    hub = sim["wheel"].joint("hub")
    hub.command_position(0.7)
    sim.run(1.0)
    # A lag of a third of a second: e⁻³ of the way is left after a second.
    assert hub.position == pytest.approx(0.7 * (1 - math.exp(-3.0)), rel=0.02)
    sim.run(5.0)
    assert hub.position == pytest.approx(0.7, abs=1e-4)


def test_a_joint_is_held_within_its_limits() -> None:
    sim = wheel(JointAxis(direction=(0.0, 0.0, 1.0), lower=-0.2, upper=0.3))
    hub = sim["wheel"].joint("hub")
    hub.command_position(5.0)
    sim.run(4.0)
    assert hub.position == pytest.approx(0.3, abs=1e-3)


def test_a_new_motor_command_replaces_the_last_one() -> None:
    sim = wheel()
    hub = sim["wheel"].joint("hub")
    hub.command_effort(0.5)
    hub.command_velocity(3.0)
    sim.run(0.5)
    assert hub.velocity == pytest.approx(3.0, rel=1e-4)
    hub.command_effort(0.0)
    hub.set_position(0.0)
    hub.set_velocity(0.0)
    sim.run(0.5)
    assert (hub.position, hub.velocity) == (0.0, 0.0)


def test_a_wrench_lasts_for_its_duration() -> None:
    sim = tumbler()
    body = sim["t"].link("body")
    body.apply_wrench(Wrench(force=(5.0, 0.0, 0.0)), duration_s=0.25)
    sim.run(1.0)
    # A first-order integrator keeps the momentum of two turning links to h times their rates.
    assert _momentum(sim) == pytest.approx((5.0 * 0.25, 0.0, 0.0), abs=5e-3)


def test_a_new_wrench_replaces_the_old_one_and_its_duration() -> None:
    sim = tumbler()
    body = sim["t"].link("body")
    body.apply_wrench(Wrench(force=(5.0, 0.0, 0.0)), duration_s=0.25)
    sim.run(0.1)
    body.apply_wrench(Wrench(force=(0.0, 1.0, 0.0)))
    sim.run(1.0)
    assert _momentum(sim) == pytest.approx((0.5, 1.0, 0.0), abs=5e-3)


def _momentum(sim: Simulation) -> tuple[float, float, float]:
    """Σ m v of the centres of mass [kg·m/s]."""
    total = np.zeros(3)
    for i, link in enumerate(sim["t"].links):
        twist = sim.engine.reader.link_twists()[i]
        arm = np.array(sim.engine.reader.center_of_mass(i)) - sim.engine.reader.link_poses()[i, :3]
        total += link.link.inertial.mass * (twist[:3] + np.cross(twist[3:], arm))
    x, y, z = total.tolist()
    return (x, y, z)


def test_twists_are_the_derivatives_of_poses() -> None:
    sim = tumbler()
    spin_up(sim)
    sim.run(0.5)
    before = sim.snapshot().poses
    sim.step()
    twists = sim.snapshot().twists
    sim.step()
    after = sim.snapshot().poses
    h2 = 2 * sim.step_ns * 1e-9
    for a, b, twist in zip(before, after, twists, strict=True):
        linear = (b[:3] - a[:3]) / h2
        turned = Pose(quaternion=tuple(b[3:].tolist())) @ Pose(quaternion=tuple(a[3:].tolist())).inverse()
        w, x, y, z = turned.quaternion
        angular = 2 * np.array([x, y, z]) * math.copysign(1.0, w) / h2
        # The engine moves a frame by the speed at a step's end: half a step's acceleration, some mm/s, apart.
        assert linear == pytest.approx(twist[:3], abs=0.02)
        assert angular == pytest.approx(twist[3:], abs=0.02)
        assert np.linalg.norm(twist[:3]) > 0.5
        assert np.linalg.norm(twist[3:]) > 0.5


def test_a_restored_state_reads_and_continues_as_the_saved_one_to_the_bit() -> None:
    sim = tumbler()
    spin_up(sim)
    sim["t"].link("arm").apply_wrench(Wrench(force=(0.0, 1.0, 0.0)), duration_s=0.5)
    sim.run(0.3)
    saved, then = sim.save(), sim.snapshot()
    sim.run(0.4)
    later = sim.snapshot()
    sim["t"].joint("elbow").command_position(1.0)
    sim.run(0.2)
    sim.restore(saved)
    assert same(sim.snapshot(), then)
    sim.run(0.4)
    assert same(sim.snapshot(), later)


def test_a_restored_motor_keeps_running() -> None:
    sim = wheel()
    hub = sim["wheel"].joint("hub")
    hub.command_velocity(4.0, max_effort=0.1)
    sim.run(0.1)
    saved = sim.save()
    sim.run(1.0)
    expected = sim.snapshot()
    hub.command_effort(-1.0)
    sim.run(0.3)
    sim.restore(saved)
    sim.run(1.0)
    assert same(sim.snapshot(), expected)


def test_a_reset_restores_the_initial_state() -> None:
    sim, fresh = tumbler(), tumbler()
    spin_up(sim)
    sim.run(0.5)
    sim.reset()
    assert same(sim.snapshot(), fresh.snapshot())
    for one in (sim, fresh):
        spin_up(one)
        one.run(0.2)
    assert same(sim.snapshot(), fresh.snapshot())


def ball(name: str, x: float) -> Model:
    shape = Collision(name="c", geometry=Sphere(0.1), at=AT)
    link = Link(name="l", at=AT, inertial=Inertial(mass=1.0, moments=(0.004, 0.004, 0.004)), collisions=(shape,))
    return Model(name=name, at=AT, world_from_model=Pose((x, 0.0, 0.1)), links=(link,))


def yard() -> Simulation:
    """Three balls on the ground; only the middle one will be ill-treated."""
    plane = Collision(name="c", geometry=Plane((0.0, 0.0, 1.0), (9.0, 9.0)), at=AT)
    ground = Model(name="ground", at=AT, static=True, links=(Link(name="l", at=AT, collisions=(plane,)),))
    balls = (ball("calm", 0.0), ball("wild", 1.0), ball("idle", 2.0))
    return Simulation(World(name="w", at=AT, models=(*balls, ground)), Diagnostics(strict=True))


def test_unstable_physics_names_the_body_and_keeps_the_last_good_state() -> None:
    sim = yard()
    sim.run(0.1)
    good = sim.snapshot()
    for force in (math.nan, math.inf):
        with pytest.raises(UsageError, match="finite"):
            sim["wild"].apply_wrench(Wrench(force=(force, 0.0, 0.0)))
    sim["wild"].apply_wrench(Wrench(force=(1e300, 0.0, 0.0)))
    with pytest.raises(SimulationUnstableError, match="'wild::l' diverged") as caught:
        sim.run(0.5)
    assert "after 0.100 s" in str(caught.value)
    assert same(sim.snapshot(), good)


def test_a_divergence_within_a_stride_is_dated_and_rolled_back() -> None:
    sim = yard()
    good = sim.snapshot()
    sim.add_hook(_Kick("wild", at_ns=250_000_000), period_ns=50_000_000)
    with pytest.raises(SimulationUnstableError, match=r"after 0\.250 s: 'wild::l'"):
        sim.run(1.0)
    assert sim.time_ns == 250_000_000
    assert np.abs(sim.snapshot().poses - good.poses).max() < 1e-3


class _Kick:
    """Pushes a model beyond all measure at one instant."""

    def __init__(self, name: str, *, at_ns: int) -> None:
        self.name = name
        self.at_ns = at_ns

    def before_step(self, sim: Simulation) -> None:
        if sim.time_ns == self.at_ns:
            sim[self.name].apply_wrench(Wrench(force=(0.0, 0.0, 1e300)))


def test_a_divergence_writes_no_log_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    sim = yard()
    sim["wild"].apply_wrench(Wrench(force=(1e300, 0.0, 0.0)))
    with pytest.raises(SimulationUnstableError):
        sim.run(0.5)
    assert list(tmp_path.iterdir()) == []


def test_a_diverged_world_continues_once_the_cause_is_removed() -> None:
    sim = yard()
    sim["wild"].apply_wrench(Wrench(force=(1e300, 0.0, 0.0)))
    with pytest.raises(SimulationUnstableError):
        sim.run(0.5)
    sim["wild"].apply_wrench(Wrench())
    sim.run(0.5)
    assert np.isfinite(sim.snapshot().poses).all()
    assert sim["calm"].pose.position == pytest.approx((0.0, 0.0, 0.1), abs=1e-3)


def test_slow_divergence_of_joints_is_detected() -> None:
    # A stride of one step looks at each state by itself: none may slip through as the last good one.
    sim = wheel()
    sim["wheel"].joint("hub").command_effort(1e10)

    def one_by_one() -> None:
        for _ in range(10_000):
            sim.step()

    with pytest.raises(SimulationUnstableError, match="'wheel::rim' diverged"):
        one_by_one()
    assert np.isfinite(sim.snapshot().joint_positions).all()
    assert np.isfinite(sim.snapshot().joint_velocities).all()


def test_a_divergence_names_the_joint_and_the_contacts() -> None:
    sim = wheel()
    sim["wheel"].joint("hub").command_effort(1e10)
    with pytest.raises(SimulationUnstableError, match="'wheel::rim' diverged on joint 'wheel::hub'") as caught:
        sim.run(10.0)
    assert caught.value.divergence.joint == "wheel::hub"
    balls = yard()
    balls.run(0.1)
    balls["wild"].apply_wrench(Wrench(force=(1e12, 0.0, -1e12)))
    with pytest.raises(SimulationUnstableError, match="touching 'ground::l::c'"):
        balls.run(0.1)


def test_a_late_divergence_is_found_within_a_second() -> None:
    sim = wheel(damping=0.0)
    sim.run(5.0)
    sim["wheel"].joint("hub").command_effort(1e5)
    # 1e7 rad/s² reach 1e6 rad/s after 0.1 s.
    with pytest.raises(SimulationUnstableError):
        sim.run(100.0)
    assert 5.0 <= sim.time_ns * 1e-9 <= 5.1
