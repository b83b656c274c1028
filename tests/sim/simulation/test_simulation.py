"""One world in motion: deterministic, commanded from any thread, with clear errors."""

import threading

import numpy as np
import pytest

from trundle.base.diagnostics import Diagnostics, Source, UsageError
from trundle.robots.model import (
    Box,
    Collision,
    Inertial,
    Joint,
    JointAxis,
    JointType,
    Link,
    Model,
    Plane,
    Sphere,
    World,
)
from trundle.sim.simulation import Simulation, Snapshot
from trundle.spatial import Pose, Wrench

AT = Source("inline.sdf", 1)


def cart() -> Simulation:
    """A box on two wheels and a skid, on the ground: contacts, joints and free bodies at once."""
    plane = Collision(name="c", geometry=Plane((0.0, 0.0, 1.0), (9.0, 9.0)), at=AT)
    ground = Model(name="ground", at=AT, static=True, links=(Link(name="l", at=AT, collisions=(plane,)),))
    hull = Collision(name="c", geometry=Box((0.4, 0.3, 0.1)), at=AT)
    body = Link(
        name="body",
        at=AT,
        model_from_link=Pose((0.0, 0.0, 0.12)),
        inertial=Inertial(mass=3.0, moments=(0.03, 0.05, 0.06)),
        collisions=(hull,),
    )
    links, joints = [body], []
    for side, y in (("left", 0.2), ("right", -0.2)):
        rim = Collision(name="c", geometry=Sphere(0.1), at=AT)
        pose = Pose((0.05, y, 0.1))
        inertial = Inertial(mass=0.5, moments=(0.002, 0.002, 0.002))
        links.append(Link(name=side, at=AT, model_from_link=pose, inertial=inertial, collisions=(rim,)))
        axis = JointAxis(direction=(0.0, 1.0, 0.0))
        joints.append(Joint(name=f"{side}_hub", type=JointType.REVOLUTE, parent="body", child=side, at=AT, axis=axis))
    model = Model(name="cart", at=AT, links=tuple(links), joints=tuple(joints))
    return Simulation(World(name="w", at=AT, models=(model, ground)), Diagnostics(strict=True))


def drive(sim: Simulation) -> None:
    sim["cart"].joint("left_hub").command_velocity(4.0, max_effort=1.0)
    sim["cart"].joint("right_hub").command_velocity(-2.0, max_effort=1.0)
    sim["cart"].link("body").apply_wrench(Wrench(force=(1.0, 0.5, 0.0)), duration_s=0.123)


def same(a: Snapshot, b: Snapshot) -> bool:
    """Return True if two snapshots agree to the last bit."""
    fields = ("poses", "twists", "joint_positions", "joint_velocities", "joint_efforts")
    return a.time_ns == b.time_ns and all(getattr(a, f).tobytes() == getattr(b, f).tobytes() for f in fields)


def test_two_runs_are_the_same_to_the_last_bit() -> None:
    ends: list[Snapshot] = []
    for _ in range(2):
        sim = cart()
        drive(sim)
        sim.run(2.0)
        ends.append(sim.snapshot())
    assert same(*ends)
    assert np.linalg.norm(ends[0].poses[0, :2]) > 0.01


class ReadingHook:
    """Hook that reads everything."""

    def __init__(self) -> None:
        self.total = 0.0

    def after_step(self, snapshot: Snapshot) -> None:
        self.total += float(snapshot.poses.sum() + snapshot.twists.sum() + snapshot.joint_efforts.sum())


class PeekingHook:
    """Hook that reads all handles before steps."""

    def before_step(self, sim: Simulation) -> None:
        body = sim["cart"].link("body")
        self.values = (body.pose, body.twist, sim.engine.reader.center_of_mass(0), sim["cart"].joint("left_hub").effort)
        sim.save()


def test_reading_the_state_does_not_change_the_simulation() -> None:
    ends: list[Snapshot] = []
    for periods_ms in ((), (1,), (7, 20), (33,)):
        sim = cart()
        for period in periods_ms:
            sim.add_hook(ReadingHook(), period_ns=period * 1_000_000)
            sim.add_hook(PeekingHook(), period_ns=period * 1_000_000)
        drive(sim)
        sim.run(1.0)
        ends.append(sim.snapshot())
    assert all(same(ends[0], end) for end in ends[1:])


def test_stride_lengths_do_not_change_the_simulation() -> None:
    whole, cut = cart(), cart()
    drive(whole)
    drive(cut)
    whole.run(1.0)
    for _ in range(250):
        cut.step(4)
    assert same(whole.snapshot(), cut.snapshot())


def test_a_run_is_rounded_up_to_whole_steps() -> None:
    sim = cart()
    sim.advance(1_500_001)
    assert (sim.steps, sim.time_ns) == (2, 2_000_000)
    sim.advance(1_000_000)
    assert sim.steps == 2
    sim.run(0.3)
    assert sim.time_ns == 302_000_000


def test_commands_of_another_thread_run_between_steps_in_order() -> None:
    sim = cart()
    times: list[tuple[int, int]] = []
    started = threading.Event()

    class Starts:
        def after_step(self, _: Snapshot) -> None:
            started.set()

    sim.add_hook(Starts(), period_ns=1_000_000)

    def talk() -> None:
        started.wait(60)
        for i in range(500):
            sim.post(lambda s, i=i: times.append((s.steps, i)))

    thread = threading.Thread(target=talk)
    thread.start()
    while len(times) < 500 and sim.time_ns < 600 * 1_000_000_000:
        sim.step(20)
    thread.join(60)
    assert [i for _, i in times] == list(range(500))
    steps = [step for step, _ in times]
    assert steps == sorted(steps)


def test_a_command_acts_before_the_next_step() -> None:
    sim = cart()
    sim.post(lambda s: s["cart"].joint("left_hub").command_velocity(4.0))
    assert sim["cart"].joint("left_hub").velocity == 0.0
    sim.step()
    assert sim["cart"].joint("left_hub").velocity > 0.0


def test_a_command_may_post_another_for_the_next_step() -> None:
    sim = cart()
    done: list[int] = []
    sim.post(lambda s: s.post(lambda t: done.append(t.steps)))
    sim.step()
    assert done == [1]


def test_a_reset_restores_the_initial_state_and_calls_callbacks() -> None:
    sim, reset_times = cart(), []
    sim.on_reset(lambda: reset_times.append(sim.time_ns))
    drive(sim)
    sim.run(0.5)
    sim.reset()
    assert same(sim.snapshot(), cart().snapshot())
    assert reset_times == [0]


def test_a_wrench_on_a_model_pushes_its_first_link() -> None:
    sim = cart()
    sim["cart"].apply_wrench(Wrench(force=(0.0, 0.0, 100.0)))
    sim.run(0.1)
    # 4 kg pulled up by 100 N.
    assert sim["cart"].link("body").twist.linear[2] == pytest.approx((100.0 / 4.0 - 9.8) * 0.1, rel=0.02)


def test_handles_agree_with_the_snapshot() -> None:
    sim = cart()
    drive(sim)
    sim.run(0.4)
    snapshot = sim.snapshot()
    for model in sim.models:
        for link in model.links:
            pose, twist = link.pose, link.twist
            assert [*pose.position, *pose.quaternion] == snapshot.poses[link.index].tolist()
            assert twist.as_list() == snapshot.twists[link.index].tolist()
        for joint in model.joints:
            assert joint.position == snapshot.joint_positions[joint.index]
            assert joint.velocity == snapshot.joint_velocities[joint.index]
            assert joint.effort == snapshot.joint_efforts[joint.index]


def test_a_snapshot_is_immutable() -> None:
    sim = cart()
    drive(sim)
    sim.run(0.1)
    snapshot, copy = sim.snapshot(), sim.snapshot()
    at_once = [copy.poses, copy.twists, copy.joint_positions, copy.joint_velocities, copy.joint_efforts]
    sim.run(0.5)
    assert not same(snapshot, sim.snapshot())
    later = [snapshot.poses, snapshot.twists]
    later += [snapshot.joint_positions, snapshot.joint_velocities, snapshot.joint_efforts]
    assert [array.tolist() for array in later] == [array.tolist() for array in at_once]


def test_unknown_names_are_refused_with_the_existing_names() -> None:
    sim = cart()
    with pytest.raises(UsageError) as no_model:
        sim["trolley"]
    assert str(no_model.value) == "no model 'trolley'; there are: 'cart', 'ground'"
    with pytest.raises(UsageError) as no_link:
        sim["cart"].link("wheel")
    assert str(no_link.value) == "model 'cart' has no link 'wheel'; there are: 'body', 'left', 'right'"
    with pytest.raises(UsageError) as no_joint:
        sim["ground"].joint("hub")
    assert str(no_joint.value) == "model 'ground' has no joint 'hub'; there are: none"


def rigid_arm(axis: JointAxis | None, kind: JointType) -> Simulation:
    joint = Joint(name="j", type=kind, parent="a", child="b", at=AT, axis=axis)
    links = (Link(name="a", at=AT), Link(name="b", at=AT))
    return Simulation(
        World(name="w", at=AT, models=(Model(name="m", at=AT, links=links, joints=(joint,)),)), Diagnostics()
    )


@pytest.mark.parametrize(
    ("axis", "kind"),
    [(JointAxis(direction=(1.0, 0.0, 0.0), lower=0.0, upper=0.0), JointType.REVOLUTE), (None, JointType.FIXED)],
)
def test_a_rigid_joint_cannot_be_driven(axis: JointAxis | None, kind: JointType) -> None:
    joint = rigid_arm(axis, kind)["m"].joint("j")
    for order in (joint.command_effort, joint.command_velocity, joint.set_position, joint.command_position):
        with pytest.raises(UsageError) as caught:
            order(0.5)
        assert str(caught.value) == "joint 'j' has no axis 0: it cannot move"
    assert (joint.position, joint.velocity, joint.effort) == (0.0, 0.0, 0.0)


def test_a_ball_joint_accepts_only_effort_commands() -> None:
    sim = rigid_arm(None, JointType.BALL)
    joint = sim["m"].joint("j")
    joint.command_effort(0.1, axis=2)
    assert joint.efforts == pytest.approx((0.0, 0.0, 0.1))
    joint.set_velocity(0.7, axis=1)
    sim.run(0.5)
    positions, velocities, efforts = sim.snapshot().axes_of(joint.index)
    assert (joint.positions, joint.velocities, joint.efforts) == (tuple(positions), tuple(velocities), tuple(efforts))
    assert abs(joint.positions[1]) > 0.1
    assert joint.position == joint.positions[0]
    for order in (joint.command_velocity, joint.set_position, joint.command_position):
        with pytest.raises(UsageError, match="is a ball joint without a single axis"):
            order(0.5)
