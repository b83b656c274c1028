"""The package that the tutorials of ROS make, which is here before a user makes it."""

from pathlib import Path

NODES = ("talker", "listener", "add_two_ints_server")
LAUNCH = "".join(f'<node pkg="beginner_tutorials" name="{name}" type="{name}.py" output="screen"/>' for name in NODES)


def test_its_nodes_talk_and_add(start, trundle, until, tmp_path: Path) -> None:
    (tmp_path / "a.launch").write_text(f"<launch>{LAUNCH}</launch>")
    launch = start("launch", "a.launch", "--headless")
    until("a listener that hears", lambda: "/listenerI heard hello world" in launch.output())

    assert "40 + 2 = 42" in trundle("exec", "beginner_tutorials", "add_two_ints_client.py", "40", "2").stdout
    assert launch.interrupt() == 130
    assert "Returning [40 + 2 = 42]" in launch.output()


def test_a_users_own_comes_first(trundle, tmp_path: Path) -> None:
    own = tmp_path / "ws/src/beginner_tutorials"
    (own / "msg").mkdir(parents=True)
    (own / "package.xml").write_text("<package><name>beginner_tutorials</name></package>")
    (own / "msg/Num.msg").write_text("int64 num\nstring name\n")

    shown = trundle("--as", "rosmsg", "show", "beginner_tutorials/Num", ROS_PACKAGE_PATH=str(tmp_path / "ws/src"))

    assert shown.stdout == "int64 num\nstring name\n\n"
    missing = trundle("exec", "beginner_tutorials", "talker.py", ROS_PACKAGE_PATH=str(tmp_path / "ws/src"))
    assert missing.returncode != 0
