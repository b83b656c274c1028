"""Files that CMake's `configure_file` would write, in a package that was not built."""

import os
from pathlib import Path

import pytest

from trundle.app.cli import main
from trundle.robots.packages import write_configured_files

CMAKE = """project(copter)
option(WITH_CAMERA "camera" ON)
option(WITH_SONAR "sonar" OFF)
list(APPEND PARTS base)
if(WITH_CAMERA AND NOT WITH_SONAR)
  list(APPEND PARTS camera)
elseif(WITH_SONAR)
  list(APPEND PARTS sonar)
endif()
foreach(PART ${PARTS})
  set(LINKS "${LINKS}<link name=\\"${PART}\\"/>\\n")
endforeach()
configure_file(urdf/copter.xacro.in ${PROJECT_SOURCE_DIR}/urdf/copter.xacro @ONLY)
file(GLOB TEMPLATES RELATIVE ${CMAKE_CURRENT_SOURCE_DIR} config/*.yaml.in)
foreach(template ${TEMPLATES})
  string(REGEX REPLACE "\\\\.in$" "" plain ${template})
  configure_file(${template} ${CMAKE_CURRENT_SOURCE_DIR}/${plain})
endforeach()
configure_file(launch/fly.launch.in ${copter_SOURCE_DIR}/launch/fly.launch COPYONLY)
configure_file(config.h.in config.h)
configure_file(config/a.in ${CATKIN_DEVEL_PREFIX}/share/${PROJECT_NAME}/made/a.yaml)
configure_file(config/a.in ${CATKIN_DEVEL_PREFIX}/${CATKIN_PACKAGE_SHARE_DESTINATION}/made/b.yaml)
configure_file(config/a.in ${CATKIN_DEVEL_PREFIX}/lib/c.yaml)
"""


@pytest.fixture
def package(tmp_path: Path) -> Path:
    folder = tmp_path / "ws/src/copter"
    files = {
        "package.xml": "<package><name>copter</name></package>",
        "CMakeLists.txt": CMAKE,
        "urdf/copter.xacro.in": "<robot name='@PROJECT_NAME@' xmlns:xacro='http://ros.org/wiki/xacro'>\n"
        "<xacro:property name='x' value='1'/>\n@LINKS@<link name='l${x}'/>@NOBODY@</robot>\n",
        "config/gains.yaml.in": "name: ${PROJECT_NAME}\np: ${GAIN}\n",
        "launch/fly.launch.in": "<launch><rosparam file='$(find copter)/config/gains.yaml'/>"
        "<param name='robot_description' command='$(find xacro)/xacro $(find copter)/urdf/copter.xacro'/></launch>",
        "config.h.in": "#cmakedefine A",
        "config/a.in": "devel: @CATKIN_DEVEL_PREFIX@\n",
    }
    for name, text in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    return folder


def test_templates_become_files_with_the_variables_of_cmakelists(package: Path) -> None:
    written = write_configured_files(package, replace=False)

    names = ["urdf/copter.xacro", "config/gains.yaml", "launch/fly.launch", "made/a.yaml", "made/b.yaml"]
    assert [str(path.relative_to(package)) for path in written] == names
    assert (package / "urdf/copter.xacro").read_text() == (
        "<robot name='copter' xmlns:xacro='http://ros.org/wiki/xacro'>\n<xacro:property name='x' value='1'/>\n"
        '<link name="base"/>\n<link name="camera"/>\n<link name=\'l${x}\'/></robot>\n'
    )
    assert (package / "config/gains.yaml").read_text() == "name: copter\np: \n"
    assert (package / "made/b.yaml").read_text() == f"devel: {package.parents[1]}/devel\n"


def test_a_launch_file_of_an_unbuilt_package_is_written_and_launched(
    package: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(package.parents[1])
    monkeypatch.delenv("ROS_PACKAGE_PATH", raising=False)

    assert main(["launch", "copter", "fly.launch", "--dump-params"]) == 0

    printed = capsys.readouterr()
    assert "/name: copter" in printed.out
    assert '<link name=\\"camera\\"' in printed.out
    assert f"wrote {package}/launch/fly.launch from its template, as catkin_make does" in printed.err


def test_catkin_make_writes_what_changed_and_a_launch_keeps_what_is_there(
    package: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    workspace = package.parents[1]
    monkeypatch.setenv("PWD", str(workspace))
    (package / "config/gains.yaml").write_text("mine: 1\n")
    write_configured_files(package, replace=False)
    assert (package / "config/gains.yaml").read_text() == "mine: 1\n"

    assert main(["--as", "catkin_make", "-C", str(workspace)]) == 0

    assert (package / "config/gains.yaml").read_text() == "name: copter\np: \n"
    lines = capsys.readouterr().out.splitlines()
    assert [line for line in lines if "configured" in line] == ["-- configured: src/copter/config/gains.yaml"]


@pytest.mark.parametrize(
    ("template", "output"),
    [
        ("in.txt", "../outside"),
        ("in.txt", "link/outside"),
        ("in.txt", ".git/hooks/pre-commit"),
        ("secret", "out.txt"),
        ("../../../secret.txt", "out.txt"),
    ],
)
def test_nothing_outside_the_package_is_read_or_written(
    package: Path, tmp_path: Path, template: str, output: str
) -> None:
    (tmp_path / "secret.txt").write_text("secret")
    (package / "in.txt").write_text("text")
    (package / "secret").symlink_to(tmp_path / "secret.txt")
    (package / "link").symlink_to(tmp_path)
    (package / "CMakeLists.txt").write_text(f"configure_file({template} ${{PROJECT_SOURCE_DIR}}/{output})")
    before = sorted(os.walk(tmp_path))

    assert write_configured_files(package, replace=True) == []
    assert sorted(os.walk(tmp_path)) == before
