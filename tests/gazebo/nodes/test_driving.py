"""Nodes between user and robot: joysticks and multiplexers."""

from typing import Any

import pytest
from tests.gazebo.nodes.conftest import PATIENCE_S

from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.twist_mux import TopicHandle, find_active_topic, read_topic_handles
from trundle.robots.parameters import ParamError
from trundle.ros import Node

TWIST = "geometry_msgs/Twist"
S = 1_000_000_000


def source(name: str, priority: int, *, timeout_s: float = 0.5, heard_s: float | None = None) -> TopicHandle:
    return TopicHandle(name, name, timeout_s, priority, None if heard_s is None else round(heard_s * S))


def test_the_fresh_source_of_highest_priority_drives() -> None:
    low, high = source("low", 10, heard_s=10.0), source("high", 100, heard_s=9.8)
    assert find_active_topic([low, high], [], 10 * S) is high
    assert find_active_topic([low, high], [], round(10.4 * S)) is low  # high has fallen silent
    assert find_active_topic([low, high], [], 20 * S) is None


def test_of_equal_priorities_the_first_drives_and_without_a_timeout_none_falls_silent() -> None:
    first, second = source("first", 10, heard_s=10.0), source("second", 10, heard_s=10.0)
    assert find_active_topic([first, second], [], 10 * S) is first
    never_heard = source("never heard", 20, timeout_s=0.0)
    assert find_active_topic([first, never_heard], [], 10 * S) is never_heard
    assert find_active_topic([source("none", 0, heard_s=10.0)], [], 10 * S) is None


def test_a_lock_masks_what_is_below_it() -> None:
    low, equal = source("low", 10, heard_s=10.0), source("equal", 50, heard_s=9.0)
    lock = source("lock", 50, timeout_s=0.0)
    assert find_active_topic([low, equal], [lock], 10 * S) is low
    lock.lock = True
    assert find_active_topic([low, equal], [lock], 10 * S) is None
    equal.received_ns = 10 * S
    assert find_active_topic([low, equal], [lock], 10 * S) is equal


def test_a_lock_that_falls_silent_masks() -> None:
    low, lock = source("low", 10, heard_s=10.0), source("lock", 50, heard_s=9.0)
    assert find_active_topic([low], [lock], 10 * S) is None


@pytest.mark.parametrize("value", [{"a": 1}, [{"name": "a"}], [{"name": "a", "topic": "t"}], ["x"]])
def test_sources_that_are_none_are_refused(value: object) -> None:
    with pytest.raises(ParamError):
        read_topic_handles(value, "/twist_mux/topics")


def test_twist_mux_passes_on_what_may_drive(stage) -> None:
    topics = [{"name": "joy", "topic": "joy_vel", "timeout": 60.0, "priority": 100}]
    topics.append({"name": "nav", "topic": "nav_vel", "timeout": 60.0, "priority": 10})
    stage.start("twist_mux/twist_mux", topics=topics)
    heard = stage.listen("/cmd_vel_out", TWIST)
    told = stage.listen("/diagnostics", "diagnostic_msgs/DiagnosticArray")
    nav, joy = stage.speak("/nav_vel", TWIST), stage.speak("/joy_vel", TWIST)
    stage.until(lambda: stage.connected("/cmd_vel_out"))
    nav.publish({"linear": {"x": 1.0}})
    stage.until(lambda: len(heard) == 1)
    joy.publish({"linear": {"x": 2.0}})
    stage.until(lambda: len(heard) == 2)
    nav.publish({"linear": {"x": 3.0}})
    joy.publish({"linear": {"x": 4.0}})
    stage.until(lambda: len(heard) == 3)

    assert [m.linear.x for m in heard] == [1.0, 2.0, 4.0]
    stage.until(lambda: told)
    values = {value.key: value.value for value in told[-1].status[0].values}
    assert values["velocity nav"] == " unmasked (listening to nav_vel @ 60.000000s with priority #10)"


def test_twist_mux_says_what_is_wrong_with_its_topics(stage, capsys) -> None:
    assert stage.start("twist_mux/twist_mux", topics={"a": 1}).result(PATIENCE_S) == 1
    assert "is not a list of topics" in capsys.readouterr().err


def test_a_virtual_joystick_drives_while_its_button_is_held(stage) -> None:
    stage.start("joy/joy_node", autorepeat_rate=50.0, deadzone=0.0)
    stage.start("teleop_twist_joy/teleop_node", axis_linear=1, scale_linear=0.7, enable_turbo_button=5)
    heard: list[Any] = stage.listen("/cmd_vel", TWIST)
    stick = stage.speak("/joy_node/set", "sensor_msgs/Joy")
    stage.until(lambda: stage.connected("/cmd_vel"))
    stick.publish({"axes": [0.5, 1.0], "buttons": [1]})
    stage.until(lambda: heard and heard[-1].linear.x)
    assert (heard[-1].linear.x, heard[-1].angular.z) == (pytest.approx(0.7), pytest.approx(0.25))

    stick.publish({"axes": [0.0, 1.0], "buttons": [0, 0, 0, 0, 0, 1]})
    stage.until(lambda: heard[-1].linear.x == pytest.approx(1.0))
    stick.publish({"axes": [0.01, 1.0], "buttons": [0]})
    stage.until(lambda: heard[-1].linear.x == 0.0)
    count = len(heard)
    stick.publish({"axes": [0.02, 1.0], "buttons": [0]})
    stick.publish({"axes": [0.5, 0.5], "buttons": [1]})
    stage.until(lambda: heard[-1].linear.x != 0.0)
    assert all(m.linear.x for m in heard[count:])  # one stop, then silence


class _Page:
    """Stand-in for the page that keeps the function that moves the joystick."""

    def __init__(self) -> None:
        self.moves: list[Any] = []

    def offer_joystick(self, move: Any) -> None:
        self.moves.append(move)

    async def show(self, node: Node, *, config: str | None, fixed_frame: str | None) -> int:
        assert config is fixed_frame is None
        await node.closed.wait()
        return 0


def test_a_joystick_of_the_page_is_told_when_it_has_moved(stage) -> None:
    page = _Page()
    stage.start("joy/joy_node", deadzone=0.5, host=NodeHost(display=page))  # pyright: ignore[reportArgumentType]
    heard: list[Any] = stage.listen("/joy", "sensor_msgs/Joy")
    stage.until(lambda: page.moves and stage.connected("/joy") and stage.linked("/joy"))
    for x, told in ((0.25, 0.0), (0.75, 0.5), (0.625, 0.25)):  # the first is within the dead zone
        for _ in range(2):  # the second says nothing new
            stage.loop.call_soon(lambda x=x: page.moves[0]((x, 1.0), (1, 0)))
        stage.until(lambda told=told: heard and heard[-1].axes[0] == told)
    assert [list(message.axes) for message in heard] == [[0.0, 1.0], [0.5, 1.0], [0.25, 1.0]]


def test_axes_by_name(stage) -> None:
    stage.start(
        "teleop_twist_joy/teleop_node",
        axis_linear={"x": 0, "y": 1},
        scale_linear={"x": 2.0, "y": 3.0},
        axis_angular={"yaw": 9},
        scale_angular={"yaw": 1.0},
    )
    heard: list[Any] = stage.listen("/cmd_vel", TWIST)
    joy = stage.speak("/joy", "sensor_msgs/Joy")
    stage.until(lambda: stage.connected("/cmd_vel"))
    joy.publish({"axes": [0.5, 1.0], "buttons": [0]})
    stage.until(lambda: heard)
    joy.publish({"axes": [0.5, 1.0], "buttons": [1]})
    stage.until(lambda: len(heard) == 2)

    assert [(m.linear.x, m.linear.y, m.angular.z) for m in heard] == [(0.0, 0.0, 0.0), (1.0, 3.0, 0.0)]
