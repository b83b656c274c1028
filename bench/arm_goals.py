"""Random valid goals of an arm's launch files, each planned, judged and executed, in a process of `trundle launch`.

Runs are headless and flat out, fake controllers on the clock of an empty world.
"""

import json
import os
import statistics
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from msgspec import Struct, field

_JUDGE = Path(__file__).parent / "arm_judge"
_CLOCK = (
    '<include file="$(find gazebo_ros)/launch/empty_world.launch">'
    '<arg name="gui" value="false"/><arg name="paused" value="false"/></include>'
)


class ArmCase(Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """Launch files of an arm with its move_group, and what its goals are."""

    launch: tuple[str, ...]
    """Launch files: 'PACKAGE FILE NAME:=VALUE …' or 'PATH NAME:=VALUE …'."""
    group: str
    repositories: tuple[str, ...] = ()
    """Folders on ROS_PACKAGE_PATH, below the folder of checkouts."""
    ns: str = ""
    """Namespace of move_group."""
    tolerance: float = 0.01
    """Tolerance of the positions at the end of a motion [rad, m]."""
    clock: bool = True
    """True: an empty world is started, for its clock."""
    floor: float | None = None
    """Height of the ground in the robot's frame [m]; None: there is none."""
    bounds: dict[str, tuple[float, float]] = field(default_factory=dict[str, tuple[float, float]])
    """Joint → bounds of its goals [rad, m]."""
    joint_states: str = ""
    """Topic of joint states; empty: joint_states."""
    env: dict[str, str] = field(default_factory=dict[str, str])
    after: str = ""
    """Node whose end, and six seconds more, the first goal waits for: it moves the arm; empty: none."""
    tags: str = ""
    """More elements of the launch file."""
    planning_time: float = 5.0
    """[s]"""


class GoalFigures(Struct, frozen=True, kw_only=True):
    """Figures of an arm's goals: all but the median are numbers of goals."""

    goals: int = 0
    planned: int = 0
    executed: int = 0
    """Planned, within limits, without contact, and where they should end."""
    within_limits: int = 0
    free_of_contact: int = 0
    median_s: float = 0.0
    """Time of a plan [s]."""
    faults: tuple[str, ...] = ()


def run_goals(
    case: ArmCase, goals: int, folder: Path, *, packages: Sequence[Path] = (), name: str = "goals", limit_s: float
) -> GoalFigures:
    """Launch a case, and send random valid goals.

    Args:
        case: launch files and group.
        goals: number of goals.
        folder: gets NAME.log and NAME.json, the rows of all goals.
        packages: folders on ROS_PACKAGE_PATH.
        name: name of these files.
        limit_s: wall time after which the run ends without figures [s].
    """
    folder = folder.absolute()
    out, launch = folder / f"{name}.json", folder / f"{name}.launch"
    out.unlink(missing_ok=True)
    launch.write_text(_launch_text(case, goals, out), encoding="utf-8")
    paths = ":".join(map(str, (_JUDGE, *packages)))
    inherited = os.environ.get("ROS_PACKAGE_PATH", "")
    env: Mapping[str, str] = {
        **os.environ,
        "ROS_PACKAGE_PATH": f"{paths}:{inherited}" if inherited else paths,
        "ROS_HOME": str(folder),
        **case.env,
    }
    command = [sys.executable, "-m", "trundle", "launch", str(launch), "--headless", "--speed", "max", "--port", "0"]
    command += ["--lenient", "--no-summary"]
    with (folder / f"{name}.log").open("w") as file:
        try:
            subprocess.run(command, env=env, check=False, stdout=file, stderr=file, timeout=limit_s)
        except subprocess.TimeoutExpired:
            return GoalFigures(faults=(f"no result in {limit_s:g} s",))
    if not out.exists():
        return GoalFigures(faults=("did not start",))
    return _figures(json.loads(out.read_text()))


def _figures(judged: dict[str, Any]) -> GoalFigures:
    rows = judged["rows"]
    planned = [row for row in rows if "planned" in row]
    faults = [f"{number}: {row['fault']}" for number, row in enumerate(rows) if "fault" in row]
    return GoalFigures(
        goals=len(rows),
        planned=len(planned),
        executed=len(rows) - len(faults),
        within_limits=sum(not row["limits"] for row in planned),
        free_of_contact=sum(not row["contacts"] for row in planned),
        median_s=statistics.median(row["s"] for row in rows) if rows else 0.0,
        faults=(*faults, *([judged["error"]] if judged["error"] else [])),
    )


def _launch_text(case: ArmCase, goals: int, out: Path) -> str:
    floor = "" if case.floor is None else case.floor
    values = {"group": case.group, "goals": goals, "out": out, "tolerance": case.tolerance, "floor": floor}
    values |= {"planning_time": case.planning_time, "after": case.after}
    params = "".join(f'<param name="{key}" value="{value}"/>' for key, value in values.items())
    params += f'<rosparam param="bounds">{json.dumps(case.bounds)}</rosparam>'
    judge = (
        f'<node pkg="arm_judge" type="judge_arm.py" name="judge_arm" required="true" output="screen">{params}</node>'
    )
    if case.joint_states:
        judge = f'<group><remap from="joint_states" to="{case.joint_states}"/>{judge}</group>'
    if case.ns:
        judge = f'<group ns="{case.ns}">{judge}</group>'
    tags = "".join(_include(words) for words in case.launch) + case.tags + judge
    return f"<launch>{_CLOCK if case.clock else ''}{tags}</launch>"


def _include(words: str) -> str:
    """Return the <include> of a launch file with its arguments."""
    first, *rest = words.split()
    file = first
    if not Path(first).is_absolute():
        name, *rest = rest
        file = f"$(find {first})/launch/{name}"
    values = "".join(
        f'<arg name="{argument.partition(":=")[0]}" value="{argument.partition(":=")[2]}"/>' for argument in rest
    )
    return f'<include file="{file}">{values}</include>'
