"""`trundle check` names the nodes that a launch does without."""

from pathlib import Path

import pytest

from trundle.gazebo.check.check_file import CheckResult, check

HERE = '<node pkg="robot_state_publisher" type="robot_state_publisher" name="there"/>'
MISSING = "node /n: no package 'no_such', and no stand-in for no_such/x; the launch"


def checked(folder: Path, nodes: str) -> CheckResult:
    file = folder / "a.launch"
    file.write_text(f"<launch>\n{HERE}\n{nodes}\n</launch>")
    return check(str(file), {"HOME": "/nobody"}, start=folder)


@pytest.mark.parametrize(
    ("required", "warnings", "errors"),
    [
        ("false", [f"warning: {MISSING} goes on without it"], []),
        ("true", [], [f"error: {MISSING} requires it"]),
    ],
)
def test_a_node_that_nothing_can_run_is_named_by_line(
    tmp_path: Path, required: str, warnings: list[str], errors: list[str]
) -> None:
    result = checked(tmp_path, f'<node pkg="no_such" type="x" name="n" required="{required}"/>')

    where = tmp_path / "a.launch"
    assert result.report.warnings == [f"{where}:3: {said}" for said in warnings]
    assert result.report.errors == [f"{where}:3: {said}" for said in errors]
    assert result.text().splitlines()[-1].startswith(f"{where}: a launch of 2 nodes")


def test_a_node_of_another_machine_may_be_there(tmp_path: Path) -> None:
    machine = '<machine name="far" address="192.0.2.7" user="u"/>'
    result = checked(tmp_path, f'{machine}<node pkg="no_such" type="x" name="n" machine="far"/>')

    assert result.report.findings == []


def test_a_program_of_a_workspace_is_found(tmp_path: Path) -> None:
    package = tmp_path / "robot"
    package.mkdir()
    (package / "package.xml").write_text("<package><name>robot</name></package>")
    (package / "drive.py").write_text("#!/usr/bin/env python3\n")
    (package / "drive.py").chmod(0o755)

    assert checked(package, '<node pkg="robot" type="drive.py" name="n"/>').report.findings == []


def test_the_command_for_a_container_has_a_nodelets_name_and_remappings(tmp_path: Path) -> None:
    """Loaded by its own process, with what the manager would have given it."""
    arguments = "load image_proc/rectify manager --no-bond _queue:=3"
    node = (
        f'<node pkg="nodelet" type="nodelet" name="rectify" ns="r1" args="{arguments}"><remap from="a" to="b"/></node>'
    )

    (warning,) = checked(tmp_path, node).report.warnings

    words = "standalone image_proc/rectify _queue:=3 a:=b __name:=rectify __ns:=/r1"
    assert f"rosrun nodelet nodelet {words}'" in warning


def test_the_command_for_a_container_has_the_nodes_name_and_remappings(tmp_path: Path) -> None:
    """Under its own name it would find none of the launch's private parameters."""
    node = '<node pkg="move_base" type="move_base" name="planner" ns="r1" args="-v"><remap from="a" to="b"/></node>'

    (warning,) = checked(tmp_path, node).report.warnings

    assert "rosrun move_base move_base -v a:=b __name:=planner __ns:=/r1" in warning
