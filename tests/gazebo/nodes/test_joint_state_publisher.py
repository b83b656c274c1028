"""joint_state_publisher selects joints and their positions as the original does."""

import math
from collections.abc import Callable, Sequence
from typing import Any

import pytest
from tests.gazebo.nodes.fakes import MESSAGES, FakeClock, FakeDisplay, FakeNode, run_to_end

from trundle.base.diagnostics import Diagnostics
from trundle.base.xmlnode import parse_xml
from trundle.gazebo.nodes import NodeHost, Slider
from trundle.gazebo.nodes.joint_state_publisher import JointSet, JointStatePublisher, JointStatePublisherGui
from trundle.robots.parameters import RosParameters
from trundle.ros import NOETIC

S = 1_000_000_000

ROBOT = """<robot name="r">
  <joint name="wheel" type="continuous"/>
  <joint name="mount" type="fixed"/>
  <joint name="lift" type="prismatic"><limit lower="0.2" upper="0.6"/></joint>
  <joint name="finger" type="revolute"><limit lower="-1" upper="1"/>
    <mimic joint="wheel" multiplier="2" offset="0.5"/></joint>
  <joint name="tip" type="revolute"><limit lower="-1" upper="1"/><mimic joint="finger" multiplier="-1"/></joint>
</robot>"""


def publish(
    params: dict[str, Any],
    *,
    robot: str = ROBOT,
    seconds: float = 1.05,
    host: NodeHost | None = None,
    distro: str = "noetic",
    kind: Callable[..., JointStatePublisher] = JointStatePublisher,
) -> FakeNode:
    node = FakeNode(FakeClock(end_ns=round((1 + seconds) * S)), {"/robot_description": robot, **params}, distro=distro)
    assert run_to_end(kind(node, [], host or NodeHost()).run()) is None
    return node


def test_free_joints_come_in_file_order_and_dependent_ones_follow() -> None:
    node = publish({"zeros": {"wheel": 0.25}})
    messages = node.sent("/joint_states")
    assert len(messages) == 11
    assert list(messages[0].name) == ["wheel", "lift", "finger", "tip"]
    # 0 is outside lift's limits; finger = 2 · 0.25 + 0.5; tip = −finger
    assert list(messages[0].position) == pytest.approx([0.25, 0.4, 1.0, -1.0])
    assert (len(messages[0].velocity), len(messages[0].effort)) == (0, 0)


def test_a_robot_nested_in_another_element_is_read() -> None:
    (first, *_) = publish({}, robot=f"<urdf>{ROBOT}</urdf>").sent("/joint_states")
    assert list(first.name) == ["wheel", "lift", "finger", "tip"]


def test_parameters_of_the_namespace_are_defaults_of_private_ones() -> None:
    node = publish({"/rate": 5, "/publish_default_velocities": True})
    assert len(node.sent("/joint_states")) == 6
    assert len(node.sent("/joint_states")[0].velocity) == 4


def test_other_publishers_move_free_joints() -> None:
    joints = JointSet(RosParameters({}, "/n"), NOETIC)
    joints.read(parse_xml(ROBOT, name="r.urdf"), Diagnostics())
    state = {"name": ["wheel", "nobody"], "position": [0.75, 9.0]}
    joints.update(MESSAGES.new("sensor_msgs/JointState", state))
    assert joints.message()["position"] == pytest.approx([0.75, 0.4, 2.0, -2.0])
    assert "velocity" not in joints.message()

    assert list(publish({"source_list": ["measured"]}).callbacks) == ["/measured"]


def test_delta_sweeps_and_a_continuous_joint_wraps() -> None:
    robot = """<robot name="r"><joint name="a" type="continuous"/>
      <joint name="b" type="revolute"><limit lower="0" upper="0.25"/></joint></robot>"""
    node = publish({"delta": 0.1}, robot=robot, seconds=4.0)
    a = [message.position[0] for message in node.sent("/joint_states")]
    b = [message.position[1] for message in node.sent("/joint_states")]
    assert b[:8] == pytest.approx([0.1, 0.2, 0.25, 0.15, 0.05, 0.0, 0.1, 0.2])
    assert max(a) <= math.pi
    assert min(a) == -math.pi


def test_safety_limits_narrow_the_range() -> None:
    robot = """<robot name="r"><joint name="a" type="revolute"><limit lower="-1" upper="1"/>
      <safety_controller soft_lower_limit="0.5" soft_upper_limit="0.9"/></joint></robot>"""
    assert list(publish({}, robot=robot).sent("/joint_states")[0].position) == pytest.approx([0.7])
    wide = publish({"use_smallest_joint_limits": False}, robot=robot)
    assert list(wide.sent("/joint_states")[0].position) == [0.0]

    one_sided = robot.replace('soft_upper_limit="0.9"', "")
    assert list(publish({}, robot=one_sided).sent("/joint_states")[0].position) == pytest.approx([0.75])
    assert list(publish({"zeros": {"a": 0}}, robot=one_sided).sent("/joint_states")[0].position) == [0.75]


def test_a_robot_without_joints_is_silent_in_noetic_only() -> None:
    robot = '<robot name="r"/>'
    assert publish({}, robot=robot).sent("/joint_states") == []
    assert len(publish({}, robot=robot, distro="indigo").sent("/joint_states")) == 11


def test_a_planar_joint_is_moved_in_indigo_only() -> None:
    robot = """<robot name="r"><joint name="plane" type="planar"><limit lower="0" upper="1"/></joint>
      <joint name="turn" type="continuous"/></robot>"""
    assert list(publish({}, robot=robot).sent("/joint_states")[0].name) == ["turn"]
    assert list(publish({}, robot=robot, distro="indigo").sent("/joint_states")[0].name) == ["plane", "turn"]


def test_a_joint_without_limits_is_reported_and_ignored() -> None:
    node = publish(
        {}, robot='<robot name="r"><joint name="a" type="revolute"/><joint name="b" type="continuous"/></robot>'
    )
    assert list(node.sent("/joint_states")[0].name) == ["b"]
    assert node.log.logged == [("warn", "joint 'a' is neither fixed nor continuous, but has no limits; it is ignored")]


@pytest.mark.parametrize(
    ("params", "message"),
    [
        ({"/robot_description": None}, "parameter /n/robot_description is not set"),
        ({"/robot_description": "<sdf/>"}, "a URDF starts with <robot>, not <sdf>"),
        ({"/robot_description": "<robot"}, "not well-formed XML"),
        ({"rate": 0}, "rate must be > 0"),
        ({"dependent_joints": {"wheel": {"parent": "tip"}}}, "Found an infinite recursive mimic chain"),
        ({"dependent_joints": {"tip2": {}}}, "/dependent_joints/tip2/parent is not set"),
    ],
)
def test_invalid_parameters_and_robots_end_it_with_an_error(params: dict[str, Any], message: str) -> None:
    node = FakeNode(FakeClock(end_ns=2 * S), {"/robot_description": ROBOT, **params})
    assert run_to_end(JointStatePublisher(node, [], NodeHost()).run()) == 1  # pyright: ignore[reportArgumentType]
    assert node.log.logged[-1][0] == "error"
    assert message in node.log.logged[-1][1]


class SliderDisplay(FakeDisplay):
    """Fake page that moves a slider at once."""

    def offer_sliders(self, sliders: Sequence[Slider], move: Callable[[str, float], None]) -> None:
        super().offer_sliders(sliders, move)
        move("wheel", 0.125)

    async def show(self, *_: object, **__: object) -> int:
        raise AssertionError("only rviz is shown")


@pytest.mark.parametrize(("kind", "params"), [(JointStatePublisherGui, {}), (JointStatePublisher, {"/use_gui": True})])
def test_sliders_on_the_page_move_joints(kind: Callable[..., JointStatePublisher], params: dict[str, Any]) -> None:
    page = SliderDisplay()
    node = publish(params, host=NodeHost(display=page), kind=kind)
    assert [slider.name for slider in page.sliders] == ["wheel", "lift"]
    assert (page.sliders[0].lower, page.sliders[0].upper) == (-math.pi, math.pi)
    assert node.sent("/joint_states")[0].position[0] == 0.125
