"""`trundle check` of a launch file reports the nodes that cannot run."""

from pathlib import Path

import pytest

from trundle.gazebo.check.check_file import CheckResult, check

SUPPORTED = '<node pkg="robot_state_publisher" type="robot_state_publisher" name="there"/>'
MISSING = "node /n: no package 'no_such', and no stand-in for no_such/x; the launch"


def check_launch(folder: Path, nodes: str) -> CheckResult:
    file = folder / "a.launch"
    file.write_text(f"<launch>\n{SUPPORTED}\n{nodes}\n</launch>")
    return check(str(file), {"HOME": "/nobody"}, start=folder)


@pytest.mark.parametrize(
    ("required", "warnings", "errors"),
    [
        ("false", [f"warning: {MISSING} goes on without it"], []),
        ("true", [], [f"error: {MISSING} requires it"]),
    ],
)
def test_an_unsupported_node_is_reported_with_its_line(
    tmp_path: Path, required: str, warnings: list[str], errors: list[str]
) -> None:
    result = check_launch(tmp_path, f'<node pkg="no_such" type="x" name="n" required="{required}"/>')

    file = tmp_path / "a.launch"
    assert result.report.warnings == [f"{file}:3: {message}" for message in warnings]
    assert result.report.errors == [f"{file}:3: {message}" for message in errors]
    assert result.text().splitlines()[-1].startswith(f"{file}: a launch of 2 nodes")


def test_a_node_on_another_machine_is_not_reported(tmp_path: Path) -> None:
    machine = '<machine name="far" address="192.0.2.7" user="u"/>'
    result = check_launch(tmp_path, f'{machine}<node pkg="no_such" type="x" name="n" machine="far"/>')

    assert result.report.findings == []


def test_a_workspace_program_is_found(tmp_path: Path) -> None:
    package = tmp_path / "robot"
    package.mkdir()
    (package / "package.xml").write_text("<package><name>robot</name></package>")
    (package / "drive.py").write_text("#!/usr/bin/env python3\n")
    (package / "drive.py").chmod(0o755)

    assert check_launch(package, '<node pkg="robot" type="drive.py" name="n"/>').report.findings == []


def test_a_nodelets_container_command_has_its_name_and_remappings(tmp_path: Path) -> None:
    """It is loaded into its own process, with the arguments that the manager would have passed."""
    arguments = "load image_proc/rectify manager --no-bond _queue:=3"
    node = (
        f'<node pkg="nodelet" type="nodelet" name="rectify" ns="r1" args="{arguments}"><remap from="a" to="b"/></node>'
    )

    (warning,) = check_launch(tmp_path, node).report.warnings

    arguments_in_container = "standalone image_proc/rectify _queue:=3 a:=b __name:=rectify __ns:=/r1"
    assert f"rosrun nodelet nodelet {arguments_in_container}'" in warning


def test_a_nodes_container_command_has_its_name_and_remappings(tmp_path: Path) -> None:
    """Under another name it would not find the launch's private parameters."""
    program = 'pkg="rtabmap_ros" type="rtabmap"'
    node = f'<node {program} name="planner" ns="r1" args="-v"><remap from="a" to="b"/></node>'

    (warning,) = check_launch(tmp_path, node).report.warnings

    assert "rosrun rtabmap_ros rtabmap -v a:=b __name:=planner __ns:=/r1" in warning
