"""urdf and interactive markers in a compiled program."""

from typing import Any

import pytest
from tests.graphs import Graph, until
from tests.ros.sdk.conftest import WAIT_S, Running

from trundle.ros import Messages

pytestmark = pytest.mark.slow
_ROBOT = """<robot name="cart">
  <material name="leaf"><color rgba="0 0.5 0 1"/></material>
  <link name="base">
    <inertial><mass value="2.5"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>
    <visual><geometry><box size="1 2 3"/></geometry><material name="leaf"/></visual>
  </link>
  <link name="wheel"/>
  <link name="twin"/>
  <joint name="axle" type="revolute">
    <parent link="base"/><child link="wheel"/>
    <origin xyz="0 0 1" rpy="0 0 0.5"/><axis xyz="0 0 1"/><limit lower="-1" upper="1.5" effort="1" velocity="1"/>
  </joint>
  <joint name="other" type="continuous"><parent link="base"/><child link="twin"/><mimic joint="axle"/></joint>
</robot>"""


def test_a_robot_is_read_and_a_marker_is_moved(running: Running, graph: Graph, messages: Messages) -> None:
    node = graph.node("tester")
    graph.loop.run(node.params.set("/robot_description", _ROBOT))
    told: list[str] = []
    markers: list[Any] = []
    node.subscribe("/told", "std_msgs/String", lambda message: told.append(message.data))
    node.subscribe("/markers/update_full", "visualization_msgs/InteractiveMarkerInit", markers.append)
    feedback = node.advertise("/markers/feedback", "visualization_msgs/InteractiveMarkerFeedback")
    process = running.start("robot", package="cpp_robot")
    assert process.stdout is not None
    lines = [process.stdout.readline() for _ in range(7)]
    assert "".join(lines) == (
        "cart 3\nbase 2.5 kg box 3 green 0.5\n axle 1 axis 1 yaw 0.5 to 1.5\n  wheel\n"
        " other 2 axis 0 yaw 0 as axle\n  twin\nend\n"
    )

    until(lambda: feedback.subscribers and markers and markers[-1].markers)
    entries = markers[-1].markers[0].menu_entries
    assert [(entry.id, entry.parent_id, entry.title) for entry in entries] == [(1, 0, "[ ] Go"), (3, 1, "Below")]

    def send(**fields: object) -> None:
        content = {"client_id": "me", "marker_name": "goal", **fields}
        feedback.publish(messages.new("visualization_msgs/InteractiveMarkerFeedback", content))

    send(event_type=1, pose={"position": {"x": 4.0}})
    send(event_type=2, menu_entry_id=1)
    send(event_type=2, menu_entry_id=999)
    send(event_type=1, marker_name="none")
    send(event_type=5, pose={"position": {"x": 4.0}})
    until(lambda: len(told) == 3)
    assert told == ["goal 1 4", "menu", "goal 5 4"]
    until(lambda: markers[-1].markers[0].menu_entries[0].title == "[x] Go")
    assert markers[-1].markers[0].pose.position.x == 4.0


@pytest.mark.parametrize(
    ("robot", "fault"),
    [
        ("<robot name='r'><link name='a'/><link name='b'/></robot>", "Two root links found: [a] and [b]"),
        ("<robot name='r'><link name='a'>", "URDF, line 1:"),
        ("<a>" * 100_000, "there are too many elements in elements"),
        (_ROBOT.replace("<limit", "<x"), "joint 'axle' is revolute but has no <limit>"),
        (_ROBOT.replace("1 2 3", "1 two 3"), "'1 two 3' is no list of numbers"),
        (_ROBOT.replace('child link="twin"', 'child link="wheel"'), "link 'wheel' has two parents"),
        (_ROBOT.replace('child link="twin"', 'child link="none"'), "joint 'other': no link 'none'"),
    ],
)
def test_an_invalid_robot_is_named(running: Running, graph: Graph, robot: str, fault: str) -> None:
    node = graph.node("tester")
    graph.loop.run(node.params.set("/robot_description", robot))
    output, _ = running.start("robot", package="cpp_robot").communicate(timeout=WAIT_S)

    assert fault in output
    assert output.endswith("invalid\n")
