"""`trundle msg` and `trundle srv`, with rosmsg's and rossrv's output."""

import io
import sys
from pathlib import Path
from typing import Any

import pytest

from trundle.app.cli import main
from trundle.ros import Messages


def _run(capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[int, str, str]:
    capsys.readouterr()
    code = main(arguments)
    out, error = capsys.readouterr()
    return code, out, error


def test_a_type_is_shown_with_its_nested_fields(capsys: pytest.CaptureFixture[str]) -> None:
    assert _run(capsys, "msg", "show", "geometry_msgs/Twist") == (
        0,
        "geometry_msgs/Vector3 linear\n  float64 x\n  float64 y\n  float64 z\n"
        "geometry_msgs/Vector3 angular\n  float64 x\n  float64 y\n  float64 z\n\n",
        "",
    )
    assert _run(capsys, "srv", "info", "std_srvs/SetBool")[1] == "bool data\n---\nbool success\nstring message\n\n"
    assert _run(capsys, "srv", "show", "-r", "turtlesim/Kill")[1] == "string name\n---\n\n"


def test_a_type_is_found_without_its_package(capsys: pytest.CaptureFixture[str], monkeypatch: Any) -> None:
    assert _run(capsys, "msg", "show", "ModelStates")[1].startswith("[gazebo_msgs/ModelStates]:\nstring[] name\n")
    both = _run(capsys, "srv", "md5", "Empty")[1]
    assert both == "".join(f"[{p}/Empty]: d41d8cd98f00b204e9800998ecf8427e\n" for p in ("roscpp", "std_srvs"))
    monkeypatch.setattr(sys, "stdin", io.StringIO("\nstd_msgs/String\n"))
    assert _run(capsys, "msg", "md5")[1] == "992ce8a1687cec8c8bd883ec73ca41d1\n"


def test_types_and_packages_are_listed(capsys: pytest.CaptureFixture[str]) -> None:
    assert _run(capsys, "msg", "package", "-s", "turtlesim")[1] == "turtlesim/Color turtlesim/Pose\n"
    assert "\ngazebo_msgs\n" in _run(capsys, "srv", "packages")[1]
    assert "\nmove_base_msgs/MoveBaseActionGoal\n" in _run(capsys, "msg", "list")[1]


@pytest.mark.parametrize(
    ("arguments", "error"),
    [
        (["msg", "show", "Nothing"], "trundle msg: error: no message type 'Nothing' in any package\n"),
        (["srv", "package", "nobody"], "trundle srv: error: no service types of a package 'nobody'\n"),
        (["msg", "md5", "a::B"], "trundle msg: error: invalid message type 'a::B'; types are written "),
        (["msg", "show", "std_msgs/Str"], "trundle msg: error: no message type 'std_msgs/Str' (did you mean "),
    ],
)  # fmt: skip
def test_an_unknown_type_is_an_error(capsys: pytest.CaptureFixture[str], arguments: list[str], error: str) -> None:
    code, out, message = _run(capsys, *arguments)
    assert (code, out) == (1, "")
    assert message.startswith(error)


@pytest.mark.slow
@pytest.mark.real_ros
def test_output_is_equal_to_rosmsg(capsys: pytest.CaptureFixture[str], original: Any, tmp_path: Path) -> None:
    """rosmsg reads definitions from packages, which are written here from Trundle's definitions."""
    messages = Messages()
    for folder, names, text in (
        ("msg", messages.type_names(), messages.text),
        ("srv", messages.service_names(), messages.service_text),
    ):
        for name in names:
            package, _, base = name.partition("/")
            (tmp_path / package / folder).mkdir(parents=True, exist_ok=True)
            (tmp_path / package / "package.xml").write_text(
                f'<package format="2"><name>{package}</name><version>1.0.0</version><description>x</description>'
                f'<maintainer email="a@example.com">a</maintainer><license>x</license></package>'
            )
            (tmp_path / package / folder / f"{base}.{folder}").write_text(text(name))
    for arguments, names in (
        (["msg", "list"], messages.type_names()),
        (["msg", "packages"], [name.partition("/")[0] for name in messages.type_names()]),
        (["srv", "list"], messages.service_names()),
        (["srv", "packages", "-s"], [name.partition("/")[0] for name in messages.service_names()]),
    ):
        expected = original(f"ros{arguments[0]}", *arguments[1:], path=tmp_path)
        known = set(names)  # rosmsg also lists Debian's packages, some of them twice
        assert _run(capsys, *arguments)[1].split() == [
            word for word in dict.fromkeys(expected.split()) if word in known
        ]
    for arguments in (
        ["msg", "package", "sensor_msgs", "-s"],
        ["msg", "show", "gazebo_msgs/ODEJointProperties"],
        ["msg", "show", "nav_msgs/Odometry"],
        ["msg", "show", "tf2_msgs/TF2Error"],
        ["msg", "show", "ModelStates"],
        ["msg", "show", "-r", "rosserial_msgs/TopicInfo"],
        ["msg", "md5", "sensor_msgs/CameraInfo"],
        ["srv", "show", "GetModelState"],
        ["srv", "show", "-r", "gazebo_msgs/SpawnModel"],
        ["srv", "md5", "std_srvs/Trigger"],
    ):
        assert _run(capsys, *arguments)[1] == original(f"ros{arguments[0]}", *arguments[1:], path=tmp_path)
