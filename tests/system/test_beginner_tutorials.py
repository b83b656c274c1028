"""The package of the ROS tutorials, which Trundle contains."""

from pathlib import Path

import pytest

NODES = ("talker", "listener", "add_two_ints_server")
LAUNCH = "".join(f'<node pkg="beginner_tutorials" name="{name}" type="{name}.py" output="screen"/>' for name in NODES)


@pytest.mark.slow
def test_talker_listener_and_add_two_ints_run(start, trundle, until, tmp_path: Path) -> None:
    (tmp_path / "a.launch").write_text(f"<launch>{LAUNCH}</launch>")
    launch = start("launch", "a.launch", "--headless")
    until("a listener that hears", lambda: "/listenerI heard hello world" in launch.output())

    assert "40 + 2 = 42" in trundle("exec", "beginner_tutorials", "add_two_ints_client.py", "40", "2").stdout
    assert launch.interrupt() == 130
    assert "Returning [40 + 2 = 42]" in launch.output()


def test_a_users_package_has_precedence(trundle, tmp_path: Path) -> None:
    package = tmp_path / "ws/src/beginner_tutorials"
    (package / "msg").mkdir(parents=True)
    (package / "package.xml").write_text("<package><name>beginner_tutorials</name></package>")
    (package / "msg/Num.msg").write_text("int64 num\nstring name\n")

    shown = trundle("--as", "rosmsg", "show", "beginner_tutorials/Num", ROS_PACKAGE_PATH=str(tmp_path / "ws/src"))

    assert shown.stdout == "int64 num\nstring name\n\n"
    missing = trundle("exec", "beginner_tutorials", "talker.py", ROS_PACKAGE_PATH=str(tmp_path / "ws/src"))
    assert missing.returncode != 0
