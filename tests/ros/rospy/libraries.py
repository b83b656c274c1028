"""Runs the programs of tests/data/rospy_libraries under an interpreter.

    python tests/ros/rospy/libraries.py FOLDER...

records in expected.json what they print with Debian's Python, its ROS packages, and those in the folders (unpacked
Debian packages python3-angles, -diagnostic-updater, …; smach and ros_numpy of their repositories).
"""

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path

ROOT = Path(__file__).parents[2] / "data/rospy_libraries"
EXPECTED = ROOT / "expected.json"
RUN = ROOT.parent / "rospy/run.py"
ALONE = sorted((ROOT / "alone").glob("*.py"))
"""Programs without a node, which share a process."""
NODES = sorted((ROOT / "node").glob("*.py"))
TIMEOUT_S = 180.0


def run_alone(python: str, programs: list[Path], env: Mapping[str, str]) -> dict[str, str]:
    """Output of each program, run one after another in one process."""
    command = [python, str(RUN), *map(str, programs)]
    completed = subprocess.run(command, env=dict(env), capture_output=True, text=True, timeout=TIMEOUT_S, check=False)
    assert completed.stdout.startswith("{"), completed.stdout + completed.stderr
    return json.loads(completed.stdout)


def run_node(python: str, program: Path, env: Mapping[str, str]) -> str:
    """Output and exit code of a program that is a node."""
    command = [python, str(program)]
    completed = subprocess.run(command, env=dict(env), capture_output=True, text=True, timeout=TIMEOUT_S, check=False)
    return f"{completed.stdout}exit code {completed.returncode}\n"


def _record(folders: list[str]) -> None:
    sys.path.insert(0, str(Path(__file__).parents[3]))
    from tests.graphs import running_graph
    from tests.ros.rospy.programs import DEBIAN, environment

    with tempfile.TemporaryDirectory() as home:
        with running_graph() as graph:
            env = environment(DEBIAN, graph.core.uri, Path(home)) | {"PYTHONPATH": os.pathsep.join(folders)}
            results = run_alone(DEBIAN, ALONE, env)
        for program in NODES:
            with running_graph() as graph:
                env["ROS_MASTER_URI"] = graph.core.uri
                results[program.name] = run_node(DEBIAN, program, env)
    EXPECTED.write_text(json.dumps(results, indent=1, sort_keys=True, ensure_ascii=False) + "\n")


if __name__ == "__main__":
    _record(sys.argv[1:])
