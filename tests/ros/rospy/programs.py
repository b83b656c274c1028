"""Runs the programs of tests/data/rospy under an interpreter.

    python tests/ros/rospy/programs.py

records in expected.json what they print with Debian's rospy.
"""

import json
import os
import re
import shlex
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path

from trundle.ros.rospy.environment import with_finder

ROOT = Path(__file__).parents[2] / "data/rospy"
EXPECTED = ROOT / "expected.json"
DEBIAN = "/usr/bin/python3"
TIMEOUT_S = 180.0
TOGETHER = {kind: sorted((ROOT / kind).glob("*.py")) for kind in ("alone", "node")}
"""Programs that share a process: those without a node, and those whose nodes have the same name."""
SINGLE = sorted((ROOT / "process").glob("*.py"))
_ARGUMENTS = re.compile(r"^# arguments: (.*)$", re.MULTILINE)
_ENVIRONMENT = re.compile(r"^# environment: (\w+)=(.*)$", re.MULTILINE)


def environment(python: str, uri: str, home: Path) -> dict[str, str]:
    """Environment of programs: Debian's Python has rospy, others get the finder."""
    env = {**os.environ, "ROS_MASTER_URI": uri, "ROS_HOME": str(home), "PYTHONWARNINGS": "ignore"}
    for name in ("ROS_PACKAGE_PATH", "ROS_NAMESPACE", "PYTHONPATH", "ROSCONSOLE_FORMAT"):
        env.pop(name, None)
    return env if python == DEBIAN else with_finder(env)


def run_together(python: str, kind: str, env: Mapping[str, str]) -> dict[str, str]:
    """Output of each program, run one after another in one process."""
    command = [python, str(ROOT / "run.py"), *map(str, TOGETHER[kind])]
    done = subprocess.run(command, env=dict(env), capture_output=True, text=True, timeout=TIMEOUT_S, check=False)
    assert done.stdout.startswith("{"), done.stdout + done.stderr
    return json.loads(done.stdout)


def run_single(python: str, program: Path, env: Mapping[str, str]) -> str:
    """Output and exit code of a program, with the arguments and variables in its comments."""
    text = program.read_text()
    arguments = [word for line in _ARGUMENTS.findall(text) for word in shlex.split(line)]
    env = {**env, **dict(_ENVIRONMENT.findall(text))}
    env["PYTHONPATH"] = os.pathsep.join(filter(None, (str(ROOT), env.get("PYTHONPATH", ""))))
    command = [python, str(program), *arguments]
    done = subprocess.run(command, env=env, capture_output=True, text=True, timeout=TIMEOUT_S, check=False)
    return f"{done.stdout}exit code {done.returncode}\n"


def _record() -> None:
    sys.path.insert(0, str(Path(__file__).parents[3]))
    from tests.graphs import running_graph

    results: dict[str, str] = {}
    with tempfile.TemporaryDirectory() as home:
        for kind in TOGETHER:
            with running_graph() as graph:
                results |= run_together(DEBIAN, kind, environment(DEBIAN, graph.core.uri, Path(home)))
        for program in SINGLE:
            with running_graph() as graph:
                env = environment(DEBIAN, graph.core.uri, Path(home))
                results[program.name] = run_single(DEBIAN, program, env)
    EXPECTED.write_text(json.dumps(results, indent=1, sort_keys=True, ensure_ascii=False) + "\n")


if __name__ == "__main__":
    _record()
