"""The published smartcar's launch on a real graph, compared with a recording of ROS.

Intended differences: names that a run assigns (/run_id, /roslaunch/uris), the text around the elements of
/robot_description, and the TFMessages without a transform that robot_state_publisher sends for every JointState of
wheels that it does not know (165 of its 302 in the recording; without them both have 10 Hz). Rates are compared on a
clock of the tests: test_arbotix.py, test_joint_state_publisher.py, test_static_transform_publisher.py.
"""

import math
import os
import re
import shlex
import threading
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest
import yaml
from tests.graphs import until

from trundle.base.diagnostics import Diagnostics
from trundle.base.supervisor import Event, Supervisor, TaskJob
from trundle.base.xmlnode import XmlNode, parse_xml
from trundle.gazebo.nodes import BuiltinReplacement, NodeHost, find_node, run_builtin_node
from trundle.robots.description import expand_xacro
from trundle.robots.launch import LaunchNode, LaunchPlan, read_launch, resolve_params
from trundle.robots.packages import Packages
from trundle.ros import Core, GraphLoop, MasterProxy, Message, Node

TIMEOUT_S = 30.0


@dataclass
class Smartcar:
    """The running launch and a node that records its messages."""

    master: MasterProxy
    onlooker: Node
    peers: Path
    received: dict[str, list[Message]] = field(default_factory=dict[str, list[Message]])
    received_condition: threading.Condition = field(default_factory=threading.Condition)

    def listen(self, topic: str, type_name: str) -> None:
        def receive(message: Message) -> None:
            with self.received_condition:
                self.received.setdefault(topic, []).append(message)
                self.received_condition.notify_all()

        self.onlooker.subscribe(topic, type_name, receive, queue_size=None)

    def wait_for(self, topic: str, count: int = 1) -> list[Message]:
        with self.received_condition:
            assert self.received_condition.wait_for(lambda: len(self.received.get(topic, [])) >= count, TIMEOUT_S), (
                topic
            )
            return list(self.received[topic])

    def forget(self) -> None:
        with self.received_condition:
            self.received.clear()


async def set_up(plan: LaunchPlan, params: Any, loop: GraphLoop, uri: str, events: list[Event]) -> Supervisor:
    setter = Node("setter", loop=loop, master_uri=uri, rosout=False)
    for param in params:
        await setter.params.set(param.name, param.value)
    await setter.shutdown()
    supervisor = Supervisor(events.append)
    for planned in plan.nodes:
        replacement = find_node(planned.package, planned.type, lambda _: None, env={})
        assert isinstance(replacement, BuiltinReplacement), replacement

        async def run(planned: LaunchNode = planned, replacement: BuiltinReplacement = replacement) -> int:
            node = Node(planned.name, loop=loop, master_uri=uri, namespace=planned.namespace)
            return await run_builtin_node(replacement, node, shlex.split(planned.arguments), NodeHost())

        await supervisor.start(TaskJob(planned.full_name, run))
    return supervisor


@pytest.fixture(scope="module")
def smartcar(shared: Path) -> Iterator[Smartcar]:
    peers = shared / "peers/ros_reference"
    report = Diagnostics()
    file = shared / "seeds/smartcar_description/launch/smartcar_display.rviz.launch"
    packages = Packages({"ROS_PACKAGE_PATH": str(shared / "seeds")}, start=file)

    def expand(xacro: Path, arguments: Mapping[str, str], /) -> str:
        return expand_xacro(xacro, arguments, packages=packages, report=report)

    plan = read_launch(file, packages=packages, report=report)
    params = resolve_params(plan, report, expand_xacro=expand, env=os.environ)
    events: list[Event] = []
    with GraphLoop() as loop:
        core = Core(loop, port=0)
        loop.run(core.start())
        onlooker = Node("onlooker", loop=loop, master_uri=core.uri)
        car = Smartcar(MasterProxy(core.uri), onlooker, peers)
        for topic, type_name in (
            ("/odom", "nav_msgs/Odometry"),
            ("/tf", "tf2_msgs/TFMessage"),
            ("/tf_static", "tf2_msgs/TFMessage"),
            ("/joint_states", "sensor_msgs/JointState"),
            ("/diagnostics", "diagnostic_msgs/DiagnosticArray"),
        ):
            car.listen(topic, type_name)
        supervisor = loop.run(set_up(plan, params, loop, core.uri, events))
        try:
            for topic in ("/tf_static", "/diagnostics", "/odom"):
                car.wait_for(topic)
            yield car
        finally:
            loop.run(supervisor.stop(), TIMEOUT_S)
            loop.run(core.stop())
            assert [event for event in events if event.kind in ("failed", "died", "finished")] == []


def sections(text: str) -> dict[str, list[str]]:
    """Split `rosnode info` or `rostopic info` into one list of bullets per heading within each subject."""
    bullets: dict[str, list[str]] = {}
    subject = heading = ""
    for line in text.splitlines():
        if match := re.match(r"(?:Node \[(.+)\]|== (.+))$", line):
            subject = match[1] or match[2]
        elif match := re.match(r"(\w+):", line):
            heading = match[1]
            bullets.setdefault(f"{subject} {heading}", [])
        elif line.startswith(" * ") and heading in ("Publications", "Subscriptions", "Services"):
            bullets[f"{subject} {heading}"].append(line[3:].split()[0])
    return bullets


def test_topics_and_services_of_each_node_are_the_originals(smartcar: Smartcar) -> None:
    expected = sections((smartcar.peers / "rosnode_info.txt").read_text())
    nodes = {node for node in (key.split()[0] for key in expected) if not node.startswith("/probe")}
    assert "/arbotix" in nodes
    headings = ("Publications", "Subscriptions", "Services")
    expected = {
        f"{node} {heading}": sorted(expected.get(f"{node} {heading}", [])) for node in nodes for heading in headings
    }

    def actual() -> dict[str, list[str]]:
        state: dict[str, Any] = dict(zip(headings, smartcar.master.call("getSystemState"), strict=True))
        links = {key: state[key.split()[1]] for key in expected}
        return {key: sorted(name for name, nodes in links[key] if key.split()[0] in nodes) for key in expected}

    until(lambda: sum(map(len, actual().values())) >= sum(map(len, expected.values())))
    assert actual() == expected


def test_topics_have_the_originals_types(smartcar: Smartcar) -> None:
    text = (smartcar.peers / "rostopic_list_v.txt").read_text()
    expected = {match[1]: match[2] for match in re.finditer(r"\* (/\S+) \[(\S+)\]", text)}
    assert dict(smartcar.master.call("getTopicTypes")) == expected


def flat(tree: object, name: str = "") -> dict[str, object]:
    if not isinstance(tree, dict):
        return {name: tree}
    return {k: v for key, value in tree.items() for k, v in flat(value, f"{name}/{key}").items()}


def tree(node: XmlNode) -> object:
    """An element without layout and comments."""
    return node.tag, sorted(node.attributes().items()), node.text, [tree(child) for child in node.children]


def test_parameters_are_the_originals(smartcar: Smartcar) -> None:
    expected = flat(yaml.safe_load((smartcar.peers / "rosparam_dump.txt").read_text()))
    actual = flat(smartcar.master.call("getParam", "/"))
    for params in (expected, actual):
        for name in [
            name for name in params if name.startswith(("/rosversion", "/rosdistro", "/run_id", "/roslaunch"))
        ]:
            del params[name]
        params["/robot_description"] = tree(parse_xml(str(params["/robot_description"]), name="robot_description"))
    assert actual == expected


def recorded(smartcar: Smartcar, name: str) -> Any:
    text = (smartcar.peers / f"msgs/{name}.yaml").read_text()
    return next(yaml.safe_load_all(text.partition("\n")[2]))


def test_fixed_joints_are_on_tf_static_as_in_the_original(smartcar: Smartcar) -> None:
    (expected,) = recorded(smartcar, "tf_static")["transforms"]
    (actual,) = smartcar.wait_for("/tf_static")[0].transforms
    assert (actual.header.frame_id, actual.child_frame_id) == (
        expected["header"]["frame_id"],
        expected["child_frame_id"],
    )
    move, turn = expected["transform"]["translation"], expected["transform"]["rotation"]
    assert [getattr(actual.transform.translation, axis) for axis in "xyz"] == pytest.approx([move[a] for a in "xyz"])
    assert [getattr(actual.transform.rotation, axis) for axis in "xyzw"] == pytest.approx([turn[a] for a in "xyzw"])


def test_wheel_transforms_are_the_originals(smartcar: Smartcar) -> None:
    expected = recorded(smartcar, "tf")["transforms"]

    def of_wheels() -> list[Any]:
        return [m.transforms for m in smartcar.wait_for("/tf") if len(m.transforms) == 4]

    until(of_wheels)
    actual = of_wheels()[0]
    assert [t.child_frame_id for t in actual] == [t["child_frame_id"] for t in expected]
    for actual_transform, expected_transform in zip(actual, expected, strict=True):
        move, turn = expected_transform["transform"]["translation"], expected_transform["transform"]["rotation"]
        assert [getattr(actual_transform.transform.translation, a) for a in "xyz"] == pytest.approx(
            [move[a] for a in "xyz"]
        )
        rotation = [getattr(actual_transform.transform.rotation, a) for a in "xyzw"]
        sign = math.copysign(1.0, rotation[3] * turn["w"])
        assert [sign * number for number in rotation] == pytest.approx([turn[a] for a in "xyzw"], abs=1e-9)


def test_both_joint_state_publishers_have_the_originals_joints(smartcar: Smartcar) -> None:
    def names() -> set[tuple[str, ...]]:
        return {tuple(message.name) for message in smartcar.wait_for("/joint_states")}

    wheels = ("left_front_wheel_joint", "right_front_wheel_joint", "left_back_wheel_joint", "right_back_wheel_joint")
    until(lambda: len(names()) > 1)
    assert names() == {wheels, ("base_l_wheel_joint", "base_r_wheel_joint")}


def test_extra_frames_keep_their_slashes(smartcar: Smartcar) -> None:
    def frames() -> set[tuple[str, str]]:
        return {(t.header.frame_id, t.child_frame_id) for m in smartcar.wait_for("/tf") for t in m.transforms}

    expected = {("/base_link", "/left_front_link"), ("/base_link", "/right_front_link"), ("odom", "base_link")}
    until(lambda: expected <= frames())


def test_the_car_drives_and_never_stops_by_itself(smartcar: Smartcar) -> None:
    """Last in this file: the car is not at its start any more."""
    publisher = smartcar.onlooker.advertise("/cmd_vel", "geometry_msgs/Twist")
    smartcar.onlooker.loop.run(smartcar.onlooker.wait_registered(), TIMEOUT_S)
    smartcar.forget()
    for _ in range(600):
        publisher.publish({"linear": {"x": 0.5}, "angular": {"z": 0.5}})
        if smartcar.wait_for("/odom", len(smartcar.received.get("/odom", [])) + 1)[-1].twist.twist.linear.x:
            break
    publisher.unregister()
    start = smartcar.wait_for("/odom")[-1]
    smartcar.forget()
    end = smartcar.wait_for("/odom", 8)[-1]
    assert (end.twist.twist.linear.x, end.twist.twist.angular.z) == (0.5, 0.5)
    moved = math.dist(
        (start.pose.pose.position.x, start.pose.pose.position.y), (end.pose.pose.position.x, end.pose.pose.position.y)
    )
    elapsed_s = (end.header.stamp.sec - start.header.stamp.sec) + (
        end.header.stamp.nanosec - start.header.stamp.nanosec
    ) * 1e-9
    # On a circle of 1 m the chord is 2 sin(w t / 2); Euler steps of up to 0.15 s stray by less than 1 %.
    assert moved == pytest.approx(2.0 * abs(math.sin(0.25 * elapsed_s)), rel=0.02)
