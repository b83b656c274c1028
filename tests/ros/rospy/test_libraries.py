"""Programs that use ROS' Python libraries print the same as with the original packages.

expected.json was recorded with Debian's packages, and with smach and ros_numpy of their repositories. Packages that
Debian installs with rospy (actionlib, rosbag, sensor_msgs, tf, tf2) are compared again where they are installed.
"""

import json
import sys
from pathlib import Path

import pytest
from tests.graphs import running_graph
from tests.ros.rospy.libraries import ALONE, EXPECTED, NODES, run_alone, run_node
from tests.ros.rospy.programs import DEBIAN, environment

_DEBIAN_HAS = {
    "actionlib_goals.py",
    "actionlib_simple.py",
    "graph_of_nodes.py",
    "launch_files.py",
    "substitution_args.py",
    "tf2_core.py",
    "tf2_printed.py",
    "tf_buffer.py",
    "tf_graph.py",
    "transformations_composed.py",
    "transformations_euler.py",
    "transformations_matrices.py",
    "transformations_quaternions.py",
    "use_point_cloud2.py",
    "use_rosbag.py",
}
_QUICK = {"tf_graph.py", "use_dynamic_reconfigure.py"}
_REAL = [
    pytest.mark.slow,
    pytest.mark.real_ros,
    pytest.mark.skipif(not Path("/usr/lib/python3/dist-packages/tf2_ros").is_dir(), reason="no tf2 is installed"),
]
_EXPECTED: dict[str, str] = json.loads(EXPECTED.read_text())


@pytest.mark.parametrize("python", [sys.executable, pytest.param(DEBIAN, marks=_REAL)], ids=["ours", "Debian's"])
def test_programs_without_a_node_print_the_same_as_with_the_original(python: str, tmp_path: Path) -> None:
    programs = [program for program in ALONE if python != DEBIAN or program.name in _DEBIAN_HAS]
    printed = run_alone(python, programs, environment(python, "http://localhost:1", tmp_path))
    assert set(printed) == {program.name for program in programs}
    assert {name: text for name, text in printed.items() if text != _EXPECTED[name]} == {}


def _nodes() -> list[object]:
    cases: list[object] = []
    for program in NODES:
        marks = [] if program.name in _QUICK else [pytest.mark.slow]
        cases.append(pytest.param(sys.executable, program, id=f"{program.stem}-ours", marks=marks))
        if program.name in _DEBIAN_HAS:
            cases.append(pytest.param(DEBIAN, program, id=f"{program.stem}-Debian's", marks=_REAL))
    return cases


@pytest.mark.parametrize(("python", "program"), _nodes())
def test_nodes_print_the_same_as_with_the_original(python: str, program: Path, tmp_path: Path) -> None:
    expected, printed = _EXPECTED[program.name], ""
    # Twice with the original, whose action client loses a goal's transition that precedes the return of send_goal.
    for _ in range(2 if python == DEBIAN else 1):
        with running_graph() as graph:
            printed = run_node(python, program, environment(python, graph.core.uri, tmp_path))
        if printed == expected:
            break
    assert printed == expected
