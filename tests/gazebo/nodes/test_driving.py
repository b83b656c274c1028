"""Joystick nodes and twist_mux."""

from typing import Any

import pytest
from tests.gazebo.nodes.conftest import PATIENCE_S
from tests.gazebo.nodes.fakes import FakeDisplay

from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.twist_mux import TopicHandle, find_active_topic, read_topic_handles
from trundle.robots.parameters import ParamError

TWIST = "geometry_msgs/Twist"
S = 1_000_000_000


def source(name: str, priority: int, *, timeout_s: float = 0.5, received_s: float | None = None) -> TopicHandle:
    return TopicHandle(name, name, timeout_s, priority, None if received_s is None else round(received_s * S))


def test_the_active_topic_has_the_highest_priority_that_has_not_timed_out() -> None:
    low, high = source("low", 10, received_s=10.0), source("high", 100, received_s=9.8)
    assert find_active_topic([low, high], [], 10 * S) is high
    assert find_active_topic([low, high], [], round(10.4 * S)) is low  # high has timed out
    assert find_active_topic([low, high], [], 20 * S) is None


def test_the_first_of_equal_priorities_is_active_and_zero_timeouts_never_expire() -> None:
    first, second = source("first", 10, received_s=10.0), source("second", 10, received_s=10.0)
    assert find_active_topic([first, second], [], 10 * S) is first
    never_received = source("never received", 20, timeout_s=0.0)
    assert find_active_topic([first, never_received], [], 10 * S) is never_received
    assert find_active_topic([source("none", 0, received_s=10.0)], [], 10 * S) is None


def test_a_lock_masks_lower_priorities() -> None:
    low, equal = source("low", 10, received_s=10.0), source("equal", 50, received_s=9.0)
    lock = source("lock", 50, timeout_s=0.0)
    assert find_active_topic([low, equal], [lock], 10 * S) is low
    lock.lock = True
    assert find_active_topic([low, equal], [lock], 10 * S) is None
    equal.received_ns = 10 * S
    assert find_active_topic([low, equal], [lock], 10 * S) is equal


def test_a_lock_that_times_out_masks() -> None:
    low, lock = source("low", 10, received_s=10.0), source("lock", 50, received_s=9.0)
    assert find_active_topic([low], [lock], 10 * S) is None


@pytest.mark.parametrize("value", [{"a": 1}, [{"name": "a"}], [{"name": "a", "topic": "t"}], ["x"]])
def test_invalid_topic_handles_are_rejected(value: object) -> None:
    with pytest.raises(ParamError):
        read_topic_handles(value, "/twist_mux/topics")


def test_twist_mux_forwards_the_active_topic(graph) -> None:
    topics = [{"name": "joy", "topic": "joy_vel", "timeout": 60.0, "priority": 100}]
    topics.append({"name": "nav", "topic": "nav_vel", "timeout": 60.0, "priority": 10})
    graph.start("twist_mux/twist_mux", topics=topics)
    messages = graph.listen("/cmd_vel_out", TWIST)
    diagnostics = graph.listen("/diagnostics", "diagnostic_msgs/DiagnosticArray")
    nav, joy = graph.advertise("/nav_vel", TWIST), graph.advertise("/joy_vel", TWIST)
    graph.until(lambda: graph.connected("/cmd_vel_out"))
    nav.publish({"linear": {"x": 1.0}})
    graph.until(lambda: len(messages) == 1)
    joy.publish({"linear": {"x": 2.0}})
    graph.until(lambda: len(messages) == 2)
    nav.publish({"linear": {"x": 3.0}})
    joy.publish({"linear": {"x": 4.0}})
    graph.until(lambda: len(messages) == 3)

    assert [m.linear.x for m in messages] == [1.0, 2.0, 4.0]
    graph.until(lambda: diagnostics)
    values = {value.key: value.value for value in diagnostics[-1].status[0].values}
    assert values["velocity nav"] == " unmasked (listening to nav_vel @ 60.000000s with priority #10)"


def test_twist_mux_reports_invalid_topics(graph, capsys) -> None:
    assert graph.start("twist_mux/twist_mux", topics={"a": 1}).result(PATIENCE_S) == 1
    assert "is not a list of topics" in capsys.readouterr().err


def test_a_virtual_joystick_drives_while_its_button_is_held(graph) -> None:
    graph.start("joy/joy_node", autorepeat_rate=50.0, deadzone=0.0)
    graph.start("teleop_twist_joy/teleop_node", axis_linear=1, scale_linear=0.7, enable_turbo_button=5)
    messages: list[Any] = graph.listen("/cmd_vel", TWIST)
    stick = graph.advertise("/joy_node/set", "sensor_msgs/Joy")
    graph.until(lambda: graph.connected("/cmd_vel"))
    stick.publish({"axes": [0.5, 1.0], "buttons": [1]})
    graph.until(lambda: messages and messages[-1].linear.x)
    assert (messages[-1].linear.x, messages[-1].angular.z) == (pytest.approx(0.7), pytest.approx(0.25))

    stick.publish({"axes": [0.0, 1.0], "buttons": [0, 0, 0, 0, 0, 1]})
    graph.until(lambda: messages[-1].linear.x == pytest.approx(1.0))
    stick.publish({"axes": [0.01, 1.0], "buttons": [0]})
    graph.until(lambda: messages[-1].linear.x == 0.0)
    count = len(messages)
    stick.publish({"axes": [0.02, 1.0], "buttons": [0]})
    stick.publish({"axes": [0.5, 0.5], "buttons": [1]})
    graph.until(lambda: messages[-1].linear.x != 0.0)
    assert all(m.linear.x for m in messages[count:])  # one stop, then nothing


def test_the_page_joystick_publishes_changes_only(graph) -> None:
    page = FakeDisplay()
    graph.start("joy/joy_node", deadzone=0.5, host=NodeHost(display=page))
    messages: list[Any] = graph.listen("/joy", "sensor_msgs/Joy")
    graph.until(lambda: page.joystick_callbacks and graph.connected("/joy") and graph.linked("/joy"))
    for x, expected in ((0.25, 0.0), (0.75, 0.5), (0.625, 0.25)):  # the first is within the dead zone
        for _ in range(2):  # the second changes nothing
            graph.loop.call_soon(lambda x=x: page.joystick_callbacks[0]((x, 1.0), (1, 0)))
        graph.until(lambda expected=expected: messages and messages[-1].axes[0] == expected)
    assert [list(message.axes) for message in messages] == [[0.0, 1.0], [0.5, 1.0], [0.25, 1.0]]


def test_axes_by_name(graph) -> None:
    graph.start(
        "teleop_twist_joy/teleop_node",
        axis_linear={"x": 0, "y": 1},
        scale_linear={"x": 2.0, "y": 3.0},
        axis_angular={"yaw": 9},
        scale_angular={"yaw": 1.0},
    )
    messages: list[Any] = graph.listen("/cmd_vel", TWIST)
    joy = graph.advertise("/joy", "sensor_msgs/Joy")
    graph.until(lambda: graph.connected("/cmd_vel"))
    joy.publish({"axes": [0.5, 1.0], "buttons": [0]})
    graph.until(lambda: messages)
    joy.publish({"axes": [0.5, 1.0], "buttons": [1]})
    graph.until(lambda: len(messages) == 2)

    assert [(m.linear.x, m.linear.y, m.angular.z) for m in messages] == [(0.0, 0.0, 0.0), (1.0, 3.0, 0.0)]
