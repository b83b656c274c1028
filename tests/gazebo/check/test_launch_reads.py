"""`trundle check` of a launch file reads only below the folders that any description reads."""

from pathlib import Path

import pytest

from trundle.base.diagnostics import Diagnostics
from trundle.gazebo.check.check_file import CheckResult, check
from trundle.robots.launch import read_launch
from trundle.robots.packages import ALLOW_OUTSIDE, Packages

_NODE = '<node pkg="rospy" type="x" name="n">{}</node>'
READS = [
    '<param name="a" textfile="{file}"/>',
    '<param name="a" binfile="{file}"/>',
    '<rosparam param="a" file="{file}"/>',
    '<include file="{file}"/>',
    '<group ns="g"><param name="a" textfile="{file}"/></group>',
    _NODE.format('<param name="a" textfile="{file}"/>'),
    _NODE.format('<rosparam param="a" file="{file}"/>'),
]


@pytest.fixture
def secret(tmp_path: Path) -> Path:
    file = tmp_path / "secret"
    file.write_text("<launch><!-- hidden --></launch>")
    return file


def check_launch(tmp_path: Path, element: str, **variables: str) -> CheckResult:
    package = tmp_path / "src/arm"
    (package / "launch").mkdir(parents=True, exist_ok=True)
    (package / "package.xml").write_text("<package><name>arm</name></package>")
    (package / "p.xml").write_text("<launch/>")
    (package / "launch/inner.launch").write_text(f"<launch>{element}</launch>")
    file = package / "launch/a.launch"
    file.write_text('<launch><include file="$(dirname)/inner.launch"/></launch>')
    return check(str(file), {"HOME": "/nobody", **variables}, start=tmp_path)


@pytest.mark.parametrize("element", READS)
@pytest.mark.parametrize("name", ["{secret}", "$(dirname)/../../../secret", "$(find arm)/link", "{secret}_missing"])
def test_a_file_outside_is_refused_by_line(tmp_path: Path, secret: Path, element: str, name: str) -> None:
    element = element.format(file=name.format(secret=secret))
    package = tmp_path / "src/arm"
    package.mkdir(parents=True)
    (package / "link").symlink_to(secret)

    result = check_launch(tmp_path, element)

    assert result.is_refused
    (error,) = result.report.errors
    assert "a description reads only below its own folders" in error
    assert "inner.launch:1: error: " in error
    assert "hidden" not in error


@pytest.mark.parametrize("element", READS)
def test_a_file_of_the_package_is_read(tmp_path: Path, element: str) -> None:
    result = check_launch(tmp_path, element.format(file="$(find arm)/p.xml"))
    assert result.report.errors == []


@pytest.mark.parametrize("element", READS)
def test_a_file_outside_can_be_allowed(tmp_path: Path, secret: Path, element: str) -> None:
    result = check_launch(tmp_path, element.format(file=secret), **{ALLOW_OUTSIDE: "1"})
    assert result.report.errors == []


def test_a_launch_reads_outside_files(tmp_path: Path, secret: Path) -> None:
    """It runs the file's programs, which may read any file anyway."""
    file = tmp_path / "a.launch"
    file.write_text(f'<launch><param name="a" textfile="{secret}"/></launch>')

    plan = read_launch(file, packages=Packages({}, start=file), report=Diagnostics())

    assert [param.value for param in plan.params] == [secret.read_text()]
