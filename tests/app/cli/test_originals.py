"""Commands without a counterpart in `trundle`: rosversion, rosclean, check_urdf, urdf_to_graphiz, gz."""

import os
import re
import shutil
from pathlib import Path
from typing import Any

import pytest

from trundle.app.cli import main

URDF = """<robot name="arm">
  <link name="base"/><link name="upper"/><link name="lower"/><link name="camera"/>
  <joint name="shoulder" type="continuous"><parent link="base"/><child link="upper"/><origin xyz="0 0 0.5"/></joint>
  <joint name="elbow" type="fixed"><parent link="upper"/><child link="lower"/></joint>
  <joint name="a_mount" type="fixed"><parent link="base"/><child link="camera"/></joint>
</robot>
"""


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, no_master: None) -> Path:
    for variable in ("ROS_LOG_DIR", "ROS_DISTRO", "ROS_PACKAGE_PATH"):
        monkeypatch.delenv(variable, raising=False)
    monkeypatch.setenv("ROS_HOME", str(tmp_path / "ros"))
    monkeypatch.chdir(tmp_path)
    (tmp_path / "arm.urdf").write_text(URDF)
    return tmp_path


def test_rosversion_prints_versions(home: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (home / "robot").mkdir()
    (home / "robot/package.xml").write_text("<package><name>robot</name><version>1.2.3</version></package>")

    assert main(["--as", "rosversion", "robot"]) == 0
    assert main(["--as", "rosversion", "-d"]) == 0
    assert capsys.readouterr().out == "1.2.3\nnoetic\n"
    assert main(["--as", "rosversion", "none"]) == 1
    assert "Cannot locate [none]" in capsys.readouterr().err


def test_rosversion_reads_the_parameter_of_the_master(graph: Any, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--as", "rosversion", "-d"]) == 0
    assert capsys.readouterr().out == "noetic\n"


def test_rosclean_measures_and_purges(
    home: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    logs = home / "ros/log"
    for number, name in enumerate(("old", "new")):
        (logs / name).mkdir(parents=True)
        (logs / name / "node.log").write_bytes(b"x" * 1024 * (1024 - 512 * number))
        os.utime(logs / name, (number, number))
    (logs / "latest").symlink_to(home)

    assert main(["--as", "rosclean", "check"]) == 0
    assert capsys.readouterr().out == "1.5M ROS node logs\n"
    monkeypatch.setattr("sys.stdin", ["n\n"])
    assert main(["--as", "rosclean", "purge"]) == 0
    assert "PLEASE BE CAREFUL" in capsys.readouterr().out
    assert (logs / "old").exists()
    assert main(["--as", "rosclean", "purge", "-y", "--size", "1"]) == 0
    assert ((logs / "old").exists(), (logs / "new").exists()) == (False, True)
    assert main(["--as", "rosclean", "purge", "-y"]) == 0
    assert not logs.exists()
    assert (home / "arm.urdf").exists(), "links are not followed"


def test_check_urdf_prints_the_tree(home: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--as", "check_urdf", "arm.urdf"]) == 0
    assert capsys.readouterr().out.splitlines() == [
        "robot name is: arm",
        "---------- Successfully Parsed XML ---------------",
        "root Link: base has 2 child(ren)",
        "    child(1):  camera",
        "    child(2):  upper",
        "        child(1):  lower",
    ]
    (home / "broken.urdf").write_text("<robot name='x'><link name='a'/><link name='b'/></robot>")
    assert main(["--as", "check_urdf", "broken.urdf"]) == 1
    assert main(["--as", "check_urdf", "none.urdf"]) == 1


def test_urdf_to_graphiz_writes_both_files(home: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--as", "urdf_to_graphiz", "arm.urdf"]) == 0

    picture = "arm.pdf" if shutil.which("dot") else "arm.svg"
    assert "Created file arm.gv" in capsys.readouterr().out
    assert (home / picture).stat().st_size > 0
    text = (home / "arm.gv").read_text()
    assert '"base" -> "shoulder" [label="xyz: 0 0 0.5 \\nrpy: 0 0 0"]' in text
    assert '"shoulder" -> "upper"' in text


def test_gz_sdf_checks_and_prints(home: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (home / "box.sdf").write_text(
        '<sdf version="1.6"><model name="box"><link name="a"><collision name="c"><geometry><box><size>1 1 1</size>'
        "</box></geometry></collision></link></model></sdf>"
    )

    assert main(["--as", "gz", "sdf", "-k", "box.sdf"]) == 0
    assert capsys.readouterr().out.endswith("Check complete\n")
    assert main(["--as", "gz", "sdf", "-p", "box.sdf"]) == 0
    assert re.search(r"<model name=.box.", capsys.readouterr().out)
    assert main(["--as", "gz", "sdf", "-k", "none.sdf"]) == 1


@pytest.mark.parametrize(
    ("line", "code"),
    [
        ("gz", 255),
        ("gz help", 0),
        ("gz help model", 0),
        ("gz --versions", 255),
        ("gz stop", 255),
        ("rostopic", 64),
        ("rostopic help", 64),
        ("rosbag", 0),
        ("rosbag help info", 0),
        ("rosmsg", 0),
    ],
)
def test_help_goes_to_the_stream_of_the_original(line: str, code: int, capsys: pytest.CaptureFixture[str]) -> None:
    """gz as in Gazebo 11's source, tools/gz.cc; the others compared with Debian's."""
    assert main(["--as", *line.split()]) == code
    printed = capsys.readouterr()
    help_text, other = (printed.err, printed.out) if line.startswith("gz") else (printed.out, printed.err)
    program = [line.split()[0], *line.split()[2:]]
    assert (f"usage: {' '.join(program)} " in help_text, other) == (True, "")
    assert all(name in help_text for name in {"gz": ["sdf", "model"], "rostopic": ["echo", "pub"]}.get(line, []))


def test_an_unknown_name_is_wrong_usage(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--as", "rosmake"]) == 2
    assert "expected one of" in capsys.readouterr().err
