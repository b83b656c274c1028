"""Key sequences are split, and keys typed into a terminal drive a robot."""

import os
import sys
from typing import Any

import pytest

from trundle.gazebo.nodes.keyboard import split_keys


def test_arrow_keys_are_split_from_others() -> None:
    assert split_keys("a\x1b[A\x1b[Db\x1b") == ["a", "up", "left", "b", "\x1b"]


@pytest.mark.skipif(os.name != "posix", reason="pseudo-terminals are POSIX only")
@pytest.mark.parametrize(
    ("program", "topic", "keys", "expected"),
    [
        ("teleop_twist_keyboard/teleop_twist_keyboard.py", "/cmd_vel", b"qi", (0.55, 0.0)),
        ("turtlebot_teleop/turtlebot_teleop_key", "/turtlebot_teleop_key/cmd_vel", b"qi", (0.22, 0.0)),
        ("turtlebot3_teleop/turtlebot3_teleop_key", "/cmd_vel", b"w" * 30 + b"a", (0.22, 0.1)),
        ("turtlesim/turtle_teleop_key", "/turtle1/cmd_vel", b"\x1b[D", (0.0, 3.0)),
    ],
)
def test_keys_typed_into_a_terminal_drive(
    graph, monkeypatch: pytest.MonkeyPatch, program: str, topic: str, keys: bytes, expected: tuple[float, float]
) -> None:
    controller_fd, terminal_fd = os.openpty()
    with os.fdopen(terminal_fd) as terminal:
        monkeypatch.setattr(sys, "stdin", terminal)
        commands: list[Any] = graph.listen(topic, "geometry_msgs/Twist")
        graph.set_params({"/scale_angular": 3.0})  # only turtlesim reads it, as a global parameter
        graph.start(program)
        graph.until(lambda: graph.connected(topic))
        os.write(controller_fd, keys)

        graph.until(lambda: any((m.linear.x, m.angular.z) == pytest.approx(expected) for m in commands))
        graph.stop()
    os.close(controller_fd)


@pytest.mark.skipif(os.name != "posix", reason="pseudo-terminals are POSIX only")
@pytest.mark.parametrize(("key_timeout", "stops"), [(0.2, True), (0.0, False)])
def test_a_repeated_command_ends_after_the_key_timeout(
    graph, monkeypatch: pytest.MonkeyPatch, key_timeout: float, stops: bool
) -> None:
    controller_fd, terminal_fd = os.openpty()
    with os.fdopen(terminal_fd) as terminal:
        monkeypatch.setattr(sys, "stdin", terminal)
        commands: list[Any] = graph.listen("/cmd_vel", "geometry_msgs/Twist")
        graph.start("teleop_twist_keyboard/teleop_twist_keyboard.py", repeat_rate=50.0, key_timeout=key_timeout)
        graph.until(lambda: graph.connected("/cmd_vel"))
        os.write(controller_fd, b"i")

        graph.until(lambda: any(m.linear.x == 0.5 for m in commands))
        if stops:
            graph.until(lambda: commands[-1].linear.x == 0.0)
        else:
            graph.until(lambda: sum(m.linear.x == 0.5 for m in commands) > 30)
            assert commands[-1].linear.x == 0.5
        graph.stop()
    os.close(controller_fd)


@pytest.mark.skipif(os.name != "posix", reason="pseudo-terminals are POSIX only")
def test_without_a_timeout_a_key_is_published_once(graph, monkeypatch: pytest.MonkeyPatch) -> None:
    controller_fd, terminal_fd = os.openpty()
    with os.fdopen(terminal_fd) as terminal:
        monkeypatch.setattr(sys, "stdin", terminal)
        commands: list[Any] = graph.listen("/cmd_vel", "geometry_msgs/Twist")
        graph.start("teleop_twist_keyboard/teleop_twist_keyboard.py", key_timeout=0.0)
        graph.until(lambda: graph.connected("/cmd_vel"))
        os.write(controller_fd, b"i")
        graph.until(lambda: commands)
        os.write(controller_fd, b",")

        graph.until(lambda: commands[-1].linear.x == -0.5)
        assert [m.linear.x for m in commands] == [0.5, -0.5]
        graph.stop()
    os.close(controller_fd)
