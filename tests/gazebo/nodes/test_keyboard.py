"""Keys are distinguished, and a terminal's keys drive a robot."""

import os
import sys
from typing import Any

import pytest

from trundle.gazebo.nodes.keyboard import split_keys


def test_arrows_are_keys_of_their_own() -> None:
    assert split_keys("a\x1b[A\x1b[Db\x1b") == ["a", "up", "left", "b", "\x1b"]


@pytest.mark.skipif(os.name != "posix", reason="terminals of this kind are POSIX's")
@pytest.mark.parametrize(
    ("what", "topic", "keys", "wanted"),
    [
        ("teleop_twist_keyboard/teleop_twist_keyboard.py", "/cmd_vel", b"qi", (0.55, 0.0)),
        ("turtlebot_teleop/turtlebot_teleop_key", "/turtlebot_teleop_key/cmd_vel", b"qi", (0.22, 0.0)),
        ("turtlebot3_teleop/turtlebot3_teleop_key", "/cmd_vel", b"w" * 30 + b"a", (0.22, 0.1)),
        ("turtlesim/turtle_teleop_key", "/turtle1/cmd_vel", b"\x1b[D", (0.0, 3.0)),
    ],
)
def test_keys_of_a_terminal_drive(
    stage, monkeypatch: pytest.MonkeyPatch, what: str, topic: str, keys: bytes, wanted: tuple[float, float]
) -> None:
    ours, theirs = os.openpty()
    with os.fdopen(theirs) as terminal:
        monkeypatch.setattr(sys, "stdin", terminal)
        heard: list[Any] = stage.listen(topic, "geometry_msgs/Twist")
        stage.set_params({"/scale_angular": 3.0})  # turtlesim's alone, beside its nodes
        stage.start(what)
        stage.until(lambda: stage.connected(topic))
        os.write(ours, keys)

        stage.until(lambda: any((m.linear.x, m.angular.z) == pytest.approx(wanted) for m in heard))
        stage.stop()
    os.close(ours)


@pytest.mark.skipif(os.name != "posix", reason="terminals of this kind are POSIX's")
@pytest.mark.parametrize(("key_timeout", "stops"), [(0.2, True), (0.0, False)])
def test_a_repeated_command_ends_with_its_key(
    stage, monkeypatch: pytest.MonkeyPatch, key_timeout: float, stops: bool
) -> None:
    ours, theirs = os.openpty()
    with os.fdopen(theirs) as terminal:
        monkeypatch.setattr(sys, "stdin", terminal)
        heard: list[Any] = stage.listen("/cmd_vel", "geometry_msgs/Twist")
        stage.start("teleop_twist_keyboard/teleop_twist_keyboard.py", repeat_rate=50.0, key_timeout=key_timeout)
        stage.until(lambda: stage.connected("/cmd_vel"))
        os.write(ours, b"i")

        stage.until(lambda: any(m.linear.x == 0.5 for m in heard))
        if stops:
            stage.until(lambda: heard[-1].linear.x == 0.0)
        else:
            stage.until(lambda: sum(m.linear.x == 0.5 for m in heard) > 30)
            assert heard[-1].linear.x == 0.5
        stage.stop()
    os.close(ours)


@pytest.mark.skipif(os.name != "posix", reason="terminals of this kind are POSIX's")
def test_without_a_time_out_a_key_is_said_once(stage, monkeypatch: pytest.MonkeyPatch) -> None:
    ours, theirs = os.openpty()
    with os.fdopen(theirs) as terminal:
        monkeypatch.setattr(sys, "stdin", terminal)
        heard: list[Any] = stage.listen("/cmd_vel", "geometry_msgs/Twist")
        stage.start("teleop_twist_keyboard/teleop_twist_keyboard.py", key_timeout=0.0)
        stage.until(lambda: stage.connected("/cmd_vel"))
        os.write(ours, b"i")
        stage.until(lambda: heard)
        os.write(ours, b",")

        stage.until(lambda: heard[-1].linear.x == -0.5)
        assert [m.linear.x for m in heard] == [0.5, -0.5]
        stage.stop()
    os.close(ours)
