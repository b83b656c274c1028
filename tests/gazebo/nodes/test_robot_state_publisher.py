"""robot_state_publisher turns joint positions into frames, when and as the original does."""

import asyncio
import math
from collections.abc import Callable, Sequence
from typing import Any

import pytest
from tests.gazebo.nodes.fakes import FakeClock, FakeNode, run_to_end

from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.robot_state_publisher import RobotStatePublisher, StatePublisher

S = 1_000_000_000

ROBOT = """<robot name="r">
  <link name="base"/><link name="arm"/><link name="finger"/><link name="head"/>
  <joint name="shoulder" type="revolute">
    <parent link="base"/><child link="arm"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/>
  </joint>
  <joint name="grip" type="prismatic">
    <parent link="arm"/><child link="finger"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="1" effort="1" velocity="1"/><mimic joint="shoulder" multiplier="2" offset="0.5"/>
  </joint>
  <joint name="neck" type="fixed"><parent link="base"/><child link="head"/><origin xyz="0 0 2"/></joint>
</robot>"""


def play(script: Callable[[FakeNode], None], params: dict[str, Any] | None = None) -> FakeNode:
    """Start the node at 100 s, run the script on it, and end it."""

    async def run() -> FakeNode:
        node = FakeNode(FakeClock(start_ns=100 * S, end_ns=10_000 * S), {"/robot_description": ROBOT, **(params or {})})
        task = asyncio.ensure_future(RobotStatePublisher(node, [], NodeHost()).run())  # pyright: ignore[reportArgumentType]
        while "/joint_states" not in node.callbacks or "/tf_static" not in node.topics:
            assert not task.done(), node.log.logged
            await asyncio.sleep(0)
        script(node)
        node.closed.set()
        assert await asyncio.wait_for(task, 60.0) == 0
        return node

    return asyncio.run(run())


def receive(node: FakeNode, names: Sequence[str], positions: Sequence[float], stamp_s: float) -> None:
    header = {"stamp": round(stamp_s * S)}
    node.receive("/joint_states", {"header": header, "name": names, "position": positions}, "sensor_msgs/JointState")


def test_moving_joints_are_published_in_name_order_with_the_messages_stamp() -> None:
    node = play(lambda node: receive(node, ["shoulder"], [0.5], 99.5))
    (message,) = node.sent("/tf")
    grip, shoulder = message.transforms
    assert (grip.header.frame_id, grip.child_frame_id) == ("arm", "finger")
    assert grip.transform.translation.y == pytest.approx(2 * 0.5 + 0.5)
    assert (shoulder.header.frame_id, shoulder.child_frame_id) == ("base", "arm")
    assert shoulder.transform.translation.x == 1.0
    assert shoulder.transform.rotation.z == pytest.approx(math.sin(0.25))
    assert (shoulder.header.stamp.sec, shoulder.header.stamp.nanosec) == (99, 500_000_000)


def test_fixed_joints_are_published_once_on_tf_static() -> None:
    node = play(lambda _: None)
    (message,) = node.sent("/tf_static")
    (neck,) = message.transforms
    assert (neck.header.frame_id, neck.child_frame_id, neck.transform.translation.z) == ("base", "head", 2.0)
    assert node.sent("/tf") == []


@pytest.mark.parametrize("params", [{}, {"use_tf_static": False}])
def test_fixed_joints_are_repeated_half_a_second_ahead_in_indigo(params: dict[str, Any]) -> None:
    clock = FakeClock(start_ns=100 * S, end_ns=101 * S)
    node = FakeNode(
        clock, {"/robot_description": ROBOT, "publish_frequency": 10, **params}, distro="noetic" if params else "indigo"
    )
    assert run_to_end(RobotStatePublisher(node, [], NodeHost()).run()) is None  # pyright: ignore[reportArgumentType]
    assert len(node.sent("/tf")) == 10
    stamp = node.sent("/tf")[0].transforms[0].header.stamp
    assert stamp.sec * S + stamp.nanosec == round(100.6 * S)


def test_planar_joints_are_fixed_and_floating_ones_ignored() -> None:
    robot = """<robot name="r"><link name="base"/><link name="a"/><link name="b"/>
      <joint name="float" type="floating"><parent link="base"/><child link="a"/></joint>
      <joint name="plane" type="planar"><parent link="base"/><child link="b"/></joint></robot>"""
    params = {"/robot_description": robot, "use_tf_static": False, "publish_frequency": 10}
    node = FakeNode(FakeClock(end_ns=round(1.15 * S)), params)
    assert run_to_end(RobotStatePublisher(node, [], NodeHost()).run()) is None  # pyright: ignore[reportArgumentType]
    assert [t.child_frame_id for t in node.sent("/tf")[0].transforms] == ["b"]


def test_messages_closer_than_the_interval_are_dropped_by_joint() -> None:
    def script(node: FakeNode) -> None:
        receive(node, ["shoulder"], [0.0], 99.0)
        receive(node, ["shoulder"], [0.1], 99.04)  # 50 ms are the interval at 20 Hz
        receive(node, ["other"], [0.0], 99.041)  # intervals are counted for each publisher's joints
        receive(node, ["shoulder"], [0.2], 99.05)

    node = play(script, {"publish_frequency": 20.0})
    angles = [2 * math.asin(m.transforms[1].transform.rotation.z) for m in node.sent("/tf")]
    assert angles == pytest.approx([0.0, 0.2])


def test_ignore_timestamp_ignores_stamps() -> None:
    def script(node: FakeNode) -> None:
        receive(node, ["shoulder"], [0.0], 99.0)
        receive(node, ["shoulder"], [0.1], 99.0)

    assert len(play(script, {"ignore_timestamp": True}).sent("/tf")) == 2


def test_backward_time_resets_the_publish_intervals() -> None:
    def script(node: FakeNode) -> None:
        receive(node, ["shoulder"], [0.0], 99.0)
        node.clock.ns = 10 * S
        receive(node, ["shoulder"], [0.1], 9.0)

    node = play(script)
    assert len(node.sent("/tf")) == 2
    assert node.log.logged[-1][1].startswith("Moved backwards in time")


def test_invalid_messages_are_reported_and_dropped() -> None:
    def script(node: FakeNode) -> None:
        receive(node, ["shoulder", "grip"], [0.0], 99.0)
        receive(node, ["shoulder"], [], 99.0)
        receive(node, ["shoulder"], [], 99.0)
        receive(node, [], [], 99.0)
        receive(node, ["nobody"], [0.0], 99.1)
        receive(node, ["nobody"], [0.0], 99.2)
        node.clock.ns += 11 * S
        receive(node, ["nobody"], [0.0], 110.0)
        receive(node, ["nobody"], [0.0], 60.0)

    node = play(script)
    assert node.sent("/tf") == []
    unknown = ("warn", 'Joint state with name: "nobody" was received but not found in URDF')
    assert [entry for entry in node.log.logged if entry == unknown] == [unknown] * 2
    assert [text for level, text in node.log.logged if level == "error"] == [
        "Robot state publisher ignored an invalid JointState message"
    ]
    assert [text for _, text in node.log.logged if "whose position member was empty" in text][1:] == []
    assert any(text.startswith("Received JointState is 51.") for _, text in node.log.logged)


@pytest.mark.parametrize("prefix", ["car", "/car/"])
def test_frames_carry_the_tf_prefix(prefix: str) -> None:
    node = play(lambda node: receive(node, ["shoulder"], [0.0], 99.0), {"/tf_prefix": prefix})
    assert node.sent("/tf")[0].transforms[1].child_frame_id == "car/arm"
    assert node.sent("/tf_static")[0].transforms[0].header.frame_id == "car/base"


@pytest.mark.parametrize(
    "params", [{}, {"/robot_description": "<robot"}, {"/robot_description": ROBOT, "publish_frequency": "x"}]
)
def test_an_invalid_robot_ends_it_with_an_error(params: dict[str, Any]) -> None:
    node = FakeNode(FakeClock(end_ns=2 * S), params)
    assert run_to_end(RobotStatePublisher(node, [], NodeHost()).run()) == 1  # pyright: ignore[reportArgumentType]
    assert node.log.logged[-1][0] == "error"


def test_state_publisher_reports_its_deprecation() -> None:
    node = FakeNode(FakeClock(end_ns=2 * S), {})
    assert run_to_end(StatePublisher(node, [], NodeHost()).run()) == 1  # pyright: ignore[reportArgumentType]
    assert node.log.logged[0] == (
        "warn",
        "The 'state_publisher' executable is deprecated. Please use 'robot_state_publisher' instead",
    )
