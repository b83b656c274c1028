"""Public arms' launch files: random valid goals, each planned, judged and executed.

`python -m bench.public_arms CHECKOUTS [NAME …]`: CHECKOUTS is a folder of repositories; NAME a case of
`public_arms.yaml` (all of them). The runs are headless and flat out, fake controllers on the clock of an empty world.
The table has the goals that were planned, those whose motion ended where it should without a fault, the median time
that a plan took, and the motions within every limit and those without contact. `GOALS=5` asks for fewer goals;
`LOGS=FOLDER` keeps each case's log and its rows as JSON.
"""

import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import yaml

_CASES = Path(__file__).with_suffix(".yaml")
_JUDGE = Path(__file__).parent / "arm_judge"
_DEFAULTS: dict[str, Any] = {
    "ns": "",
    "tolerance": 0.01,
    "clock": True,
    "floor": "",
    "bounds": {},
    "joint_states": "",
    "env": {},
    "tags": "",
    "planning_time": 5.0,
}
"""Options of a case. `ns`: namespace of its move_group; `tolerance`: of where a motion ends [rad, m]; `clock`: True: an
empty world is started, for its clock; `floor`: height of the ground in the robot's frame [m]; `bounds`: joint → bounds
of its goals [rad, m]; `joint_states`: topic; `tags`: more of the launch file; `planning_time` [s]."""
_GOALS = 50
_LIMIT_S = 900.0
_CLOCK = (
    '<include file="$(find gazebo_ros)/launch/empty_world.launch">'
    '<arg name="gui" value="false"/><arg name="paused" value="false"/></include>'
)


def main(words: list[str]) -> int:
    """Run cases, and print a table."""
    checkouts, names = Path(words[0]).absolute(), words[1:]
    cases = yaml.safe_load(_CASES.read_text())
    failed = 0
    print("| package | planned | executed | median plan | limits kept | no contact | what failed |")
    print("|---|---|---|---|---|---|---|")
    for name, case in cases.items():
        if not names or name in names:
            with tempfile.TemporaryDirectory() as folder:
                row, is_good = _run(name, {**_DEFAULTS, **case}, checkouts, Path(folder))
            failed += not is_good
            print(row, flush=True)
    return min(failed, 1)


def _run(name: str, case: dict[str, Any], checkouts: Path, folder: Path) -> tuple[str, bool]:
    logs = Path(os.environ.get("LOGS", folder))
    plain = name.replace(" ", "_").replace(",", "")
    out, launch = logs / f"{plain}.json", folder / "case.launch"
    out.unlink(missing_ok=True)
    goals = int(os.environ.get("GOALS", _GOALS))
    values = {"group": case["group"], "goals": goals, "out": str(out.absolute()), "tolerance": case["tolerance"]}
    values |= {"planning_time": case["planning_time"], "floor": case["floor"]}
    params = "".join(f'<param name="{key}" value="{value}"/>' for key, value in values.items())
    params += f'<rosparam param="bounds">{json.dumps(case["bounds"])}</rosparam>'
    judge = (
        f'<node pkg="arm_judge" type="judge_arm.py" name="judge_arm" required="true" output="screen">{params}</node>'
    )
    if case["joint_states"]:
        judge = f'<group><remap from="joint_states" to="{case["joint_states"]}"/>{judge}</group>'
    if case["ns"]:
        judge = f'<group ns="{case["ns"]}">{judge}</group>'
    tags = "".join(_include(words) for words in case["launch"]) + case["tags"] + judge
    launch.write_text(f"<launch>{_CLOCK if case['clock'] else ''}{tags}</launch>")
    paths = [str(_JUDGE), *(str(checkouts / repository) for repository in case["repositories"])]
    variables = {"ROS_PACKAGE_PATH": ":".join(paths), "ROS_HOME": str(folder), **case["env"]}
    command = [sys.executable, "-m", "trundle", "launch", str(launch), "--headless", "--speed", "max", "--port", "0"]
    command += ["--lenient", "--no-summary"]
    with (logs / f"{plain}.log").open("w") as file:
        try:
            subprocess.run(
                command, env={**os.environ, **variables}, check=False, stdout=file, stderr=file, timeout=_LIMIT_S
            )
        except subprocess.TimeoutExpired:
            return f"| {name} | – | – | – | – | – | no result in {_LIMIT_S:g} s |", False
    if not out.exists():
        return f"| {name} | – | – | – | – | – | did not start |", False
    judged = json.loads(out.read_text())
    rows = judged["rows"]
    planned = [row for row in rows if "planned" in row]
    executed = sum("fault" not in row for row in rows)
    within, free = (sum(not row[key] for row in planned) for key in ("limits", "contacts"))
    median_s = statistics.median(row["s"] for row in rows) if rows else 0.0
    faults = [f"{number}: {row['fault']}" for number, row in enumerate(rows) if "fault" in row]
    listed = "; ".join([*faults, *([judged["error"]] if judged["error"] else [])])
    figures = f"{len(planned)} of {goals} | {executed} | {median_s:.3f} s | {within} | {free}"
    return f"| {name} | {figures} | {listed} |", executed >= 0.98 * goals


def _include(words: str) -> str:
    """Return the <include> of 'PACKAGE FILE NAME:=VALUE …'."""
    package, file, *arguments = words.split()
    values = "".join(
        f'<arg name="{argument.partition(":=")[0]}" value="{argument.partition(":=")[2]}"/>' for argument in arguments
    )
    return f'<include file="$(find {package})/launch/{file}">{values}</include>'


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
