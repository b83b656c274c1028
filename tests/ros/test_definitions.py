"""Shipped definitions, and those of packages on the package path."""

import subprocess
from pathlib import Path

import pytest

from trundle.ros import MessageError, Messages

SUMS = Path(__file__).parent / "data" / "md5sums.txt"
"""Type and md5 sum, as genmsg computes it from the original definitions of ROS Noetic."""


def test_every_md5_sum_matches_noetic(messages: Messages) -> None:
    expected = dict(line.split() for line in SUMS.read_text().splitlines())
    sums = {name: messages.md5(name) if messages.has(name) else messages.service(name).md5sum for name in expected}
    assert sums == expected


_DEBIANS_SUMS = """
import glob, importlib, os
for path in glob.glob("/usr/lib/python3/dist-packages/*/*/_*.py"):
    package, kind, name = path.split("/")[-3:]
    if kind in ("msg", "srv") and name != "__init__.py":
        base = name[1:-3]
        made = getattr(importlib.import_module(f"{package}.{kind}"), base)
        print(kind, f"{package}/{base}", made._md5sum)
"""


@pytest.mark.real_ros
def test_every_md5_sum_matches_debians_rospy(messages: Messages) -> None:
    """Sums as `rosmsg md5` prints them."""
    if not Path("/usr/lib/python3/dist-packages/std_msgs/msg").is_dir():
        pytest.skip("Debian's python3-std-msgs is not installed")
    done = subprocess.run(["/usr/bin/python3", "-c", _DEBIANS_SUMS], capture_output=True, text=True, timeout=100)
    sums = [line.split() for line in done.stdout.splitlines()]
    assert done.returncode == 0, done.stderr
    assert len(sums) > 30  # std_msgs alone has 34
    assert [
        (name, messages.service(name).md5sum if kind == "srv" else messages.md5(name)) for kind, name, _ in sums
    ] == [(name, md5) for _, name, md5 in sums]


def test_every_shipped_type_can_be_built(messages: Messages) -> None:
    for name in messages.type_names():
        assert messages.serialize(messages.new(name)) is not None
    for name in messages.service_names():
        assert messages.service(name).type == name
    assert {"gazebo_msgs/LinkStates", "control_msgs/FollowJointTrajectoryActionGoal"} <= set(messages.type_names())
    assert {"gazebo_msgs/SpawnModel", "dynamic_reconfigure/Reconfigure"} <= set(messages.service_names())


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A user's package with messages, a service and an action."""
    package = tmp_path / "my_robot_msgs"
    for folder in ("msg", "srv", "action"):
        (package / folder).mkdir(parents=True)
    (package / "package.xml").write_text("<package><name>my_robot_msgs</name></package>")
    (package / "msg" / "Wheel.msg").write_text("# a wheel\nHeader header\nfloat64 SPAN=1.50 # m\nfloat64 rpm\n")
    (package / "msg" / "Base.msg").write_text("Wheel[2] wheels\ngeometry_msgs/Pose pose\n")
    (package / "srv" / "Stop.srv").write_text("Wheel wheel\n---\nbool done\n")
    (package / "action" / "Dock.action").write_text("Base base\n---\nbool docked\n---\nfloat32 distance\n")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    return package


def test_a_users_definitions_are_read_from_the_package_path(workspace: Path) -> None:
    messages = Messages()
    base = messages.new("my_robot_msgs/Base", {"wheels": [{"rpm": 1.0}, {"rpm": 2.0}]})
    again = messages.deserialize(messages.serialize(base), "my_robot_msgs/Base")
    assert [wheel.rpm for wheel in again.wheels] == [1.0, 2.0]
    assert messages.fields("my_robot_msgs/DockActionFeedback") == {
        "header": "std_msgs/Header",
        "status": "actionlib_msgs/GoalStatus",
        "feedback": "my_robot_msgs/DockFeedback",
    }
    assert Messages().service("my_robot_msgs/Stop").request == "my_robot_msgs/StopRequest"
    assert "my_robot_msgs/DockGoal" in Messages().type_names()
    assert "my_robot_msgs/Stop" in Messages().service_names()


def test_an_unknown_type_is_reported_with_the_known_ones(workspace: Path) -> None:
    with pytest.raises(MessageError, match=r"messages of my_robot_msgs: Base, DockAction, .*Wheel"):
        Messages().md5("my_robot_msgs/Whel")
    (workspace / "msg" / "Bad.msg").write_text("float64[\n")
    with pytest.raises(MessageError, match=r"/msg/Bad\.msg:1: not a field: 'float64\['; fields are written TYPE NAME"):
        Messages().md5("my_robot_msgs/Bad")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("# where a thing is\nPoint position  # [m]\nQuaternion orientation\n", "with comments"),
        ("Point position\nfloat64 yaw\n", "as it is known here"),
        ("float64[ position\n", "as it is known here"),
    ],
    ids=["the same type", "another", "none"],
)
def test_an_equal_installed_definition_is_used_with_its_comments(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, text: str, expected: str
) -> None:
    """`rosbag check` compares a bag's definition with the installed one; md5 sums and fields are unchanged."""
    monkeypatch.setattr("trundle.ros.messages.definition_search.DEBIAN_SHARE", "")
    shipped = Messages().definition("geometry_msgs/Pose")
    file = tmp_path / "geometry_msgs" / "msg" / "Pose.msg"
    file.parent.mkdir(parents=True)
    file.write_text(text)
    monkeypatch.setenv("ROS_PACKAGE_PATH", f"/nowhere:{tmp_path}")
    messages = Messages()
    head, _, rest = shipped.partition("=" * 80)
    text_sent, separator, others = messages.definition("geometry_msgs/Pose").partition("=" * 80)
    assert text_sent == (f"{text}\n" if expected == "with comments" else head)
    assert separator + others == "=" * 80 + rest
    assert messages.md5("geometry_msgs/Pose") == Messages().md5("geometry_msgs/Pose")
    assert list(messages.fields("geometry_msgs/Pose")) == ["position", "orientation"]


def test_an_installed_definition_without_fields_is_used_too(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A generated action's feedback may consist of comments only; `rosbag check` fails without them."""
    file = tmp_path / "std_msgs" / "msg" / "Empty.msg"
    file.parent.mkdir(parents=True)
    file.write_text("# nothing to say\n")
    monkeypatch.setattr("trundle.ros.messages.definition_search.DEBIAN_SHARE", "")
    monkeypatch.setenv("ROS_PACKAGE_PATH", f"/nowhere:{tmp_path}")
    assert Messages().definition("std_msgs/Empty") == "# nothing to say\n"
    assert Messages().md5("std_msgs/Empty") == "d41d8cd98f00b204e9800998ecf8427e"
