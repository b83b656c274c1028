"""Links attached and detached while the world runs."""

from pathlib import Path

import pytest

import trundle
from trundle.base.diagnostics import Source, UsageError
from trundle.robots.model import Joint, JointAxis, JointType
from trundle.sim.simulation import Simulation
from trundle.spatial import Pose, Twist

BODY = """<link name="l"><inertial><mass>2</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia>
</inertial></link>"""
ARM = """<link name="arm"><pose>0 0 0.5 0 0 0</pose><inertial><mass>1</mass></inertial></link><joint name="hinge"
type="revolute"><parent>l</parent><child>arm</child><axis><xyz>0 1 0</xyz></axis></joint>"""


@pytest.fixture
def sim(tmp_path: Path) -> Simulation:
    """Two bodies that fly apart, the second turning and swinging an arm."""
    file = tmp_path / "w.sdf"
    models = f'<model name="a"><pose>0 0 1 0 0 0</pose>{BODY}</model>'
    models += f'<model name="b"><pose>1 0 1 0 0 0.3</pose>{BODY}{ARM}</model>'
    file.write_text(f'<sdf version="1.6"><world name="w"><gravity>0 0 -10</gravity>{models}</world></sdf>')
    sim = trundle.load(str(file))
    sim["a"].set_twist(Twist((0.0, 1.0, 0.0)))
    sim["b"].set_twist(Twist((0.0, 2.0, 0.0), (0.0, 0.0, 1.0)))
    sim["b"].joint("hinge").set_velocity(1.0)
    sim.run(0.5)
    return sim


def joint(kind: JointType, parent: str, child: str, axis: JointAxis | None = None) -> Joint:
    return Joint(name="tie", type=kind, parent=parent, child=child, at=Source("test"), axis=axis)


def same(a: Pose, b: Pose) -> bool:
    return a.position == pytest.approx(b.position, abs=1e-9) and a.rpy == pytest.approx(b.rpy, abs=1e-9)


@pytest.mark.parametrize("child", ["b::l", "b::arm"])
def test_a_link_attached_to_the_world_stays_and_falls_when_detached(sim: Simulation, child: str) -> None:
    before = [link.pose for model in sim.models for link in model.links]
    sim.attach(joint(JointType.FIXED, "world", child))
    after = [link.pose for model in sim.models for link in model.links]
    assert all(same(a, b) for a, b in zip(before, after, strict=True))

    attached = sim["b"].link(child.split("::")[1])
    sim.run(1.0)
    assert attached.pose.position == pytest.approx(before[1 if child == "b::l" else 2].position, abs=2e-3)
    sim.detach("tie")
    height = attached.pose.position[2]
    sim.run(0.5)
    assert attached.pose.position[2] < height - 0.3


def test_a_model_fixed_to_the_world_is_moved_with_its_joint(sim: Simulation) -> None:
    """Its arm keeps its angle."""
    sim.attach(joint(JointType.FIXED, "world", "b::l"))
    angle = sim["b"].joint("hinge").position
    target = Pose((4.0, 5.0, 6.0), Pose.from_rpy(0.0, 0.0, 0.0, 0.0, 0.0, 0.7).quaternion)

    sim["b"].set_pose(target)

    assert same(sim["b"].pose, target)
    assert sim["b"].joint("hinge").position == pytest.approx(angle)
    sim.run(0.5)
    assert same(sim["b"].pose, target)


def test_two_attached_models_move_as_one(sim: Simulation) -> None:
    one, other = sim["a"].link("l"), sim["b"].link("l")
    before = one.pose.inverse() @ other.pose
    sim.attach(joint(JointType.FIXED, "a::l", "b::l"))
    sim.run(0.3)
    assert same(one.pose.inverse() @ other.pose, before)

    poses, twists = (one.pose, other.pose), other.twist
    sim.detach("tie")
    assert all(same(a, b) for a, b in zip(poses, (one.pose, other.pose), strict=True))
    assert other.twist.linear == pytest.approx(twists.linear)
    assert other.twist.angular == pytest.approx(twists.angular)


def test_an_attached_joint_moves_along_its_axis_in_the_world(sim: Simulation) -> None:
    slide = JointAxis(direction=(1.0, 0.0, 0.0))
    tie = sim.attach(joint(JointType.PRISMATIC, "world", "b::l", slide))
    x, y, z = sim["b"].link("l").pose.position
    tie.command_velocity(0.5)
    sim.run(1.0)

    assert tie.position == pytest.approx(0.5, abs=0.02)
    assert sim["b"].link("l").pose.position == pytest.approx((x + tie.position, y, z), abs=1e-6)


def test_impossible_attachments_and_detachments_are_refused(sim: Simulation) -> None:
    sim.attach(joint(JointType.FIXED, "world", "b::l"))

    for wrong, words in (
        (joint(JointType.FIXED, "world", "a::l"), "there is a joint 'tie' already"),
        (Joint(name="x", type=JointType.FIXED, parent="a", child="b::l", at=Source("t")), "no link 'a'"),
        (Joint(name="x", type=JointType.FIXED, parent="a::l", child="world", at=Source("t")), "must be a link"),
    ):
        with pytest.raises(UsageError, match=words):
            sim.attach(wrong)
    with pytest.raises(UsageError, match="no joint between models 'rope'; there are: 'tie'"):
        sim.detach("rope")


@pytest.mark.parametrize("turned", [False, True])
@pytest.mark.parametrize("box", ["free", "hung", "static"])
def test_a_body_attached_to_a_bent_arm_stays_and_holds_it(tmp_path: Path, box: str, *, turned: bool) -> None:
    """The arm hangs from the world and is bent, the box flies, hangs from the world too, or is part of it."""
    hung = '<joint name="w" type="fixed"><parent>world</parent><child>l</child></joint>'
    more = {"free": "", "hung": hung, "static": "<static>1</static>"}[box]
    boxes = f'<model name="box"><pose>0 0 3 0 0 0.5</pose>{more}{BODY}</model>'
    models = f'<model name="robot"><pose>0 0 1 0 0 0</pose>{BODY}{ARM}{hung}</model>{boxes}'
    file = tmp_path / "w.sdf"
    file.write_text(f'<sdf version="1.6"><world name="w"><gravity>0 0 0</gravity>{models}</world></sdf>')
    sim = trundle.load(str(file))
    hinge, arm, link = sim["robot"].joint("hinge"), sim["robot"].link("arm"), sim["box"].link("l")
    hinge.set_position(1.2)
    sim.step()
    before = [part.pose for model in sim.models for part in model.links]
    ends = ("box::l", "robot::arm") if turned else ("robot::arm", "box::l")
    sim.attach(joint(JointType.FIXED, *ends))
    assert all(same(a, part.pose) for a, part in zip(before, [ln for m in sim.models for ln in m.links], strict=True))

    arm_from_box = arm.pose.inverse() @ link.pose
    hinge.command_effort(0.5)
    sim.run(0.5)
    assert (hinge.position == pytest.approx(1.2, abs=1e-4)) is (box != "free")
    now = arm.pose.inverse() @ link.pose
    assert now.position == pytest.approx(arm_from_box.position, abs=1e-4)

    sim.detach("tie")
    sim.reset()
    assert same(link.pose, before[-1]), "a reset restores the initial pose, attached or not"
