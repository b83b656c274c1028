"""Commands in words, as moveit_commander_cmdline.py reads them."""

import re
import time
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import rospy

from .conversions import list_to_pose, list_to_pose_stamped
from .exception import MoveItCommanderException
from .move_group import MoveGroupCommander
from .planning_scene_interface import PlanningSceneInterface
from .robot import RobotCommander

_COPY = re.compile(r"(\w+)\s*=\s*(\w+)")
_VECTOR = re.compile(r"(\w+)\s*=\s*\[([-+\d.eE\s]+)\]")
_ELEMENT = re.compile(r"(\w+)\s*\[\s*(\d+)\s*\]\s*=\s*([-+\d.eE]+)")
_DIRECTIONS = {
    "x": (0, 1.0), "forward": (0, 1.0), "back": (0, -1.0), "backward": (0, -1.0),
    "y": (1, 1.0), "left": (1, 1.0), "right": (1, -1.0),
    "z": (2, 1.0), "up": (2, 1.0), "down": (2, -1.0),
}  # fmt: skip
_ALONE: tuple[str, ...] = (
    "help", "wait", "database", "group_state", "current", "load", "save", "pick", "place", "vars", "joints",
    "tolerance", "time", "eef", "execute", "ground", "id", "constrain",
)  # fmt: skip
_MAX_DEPTH = 10
"""Depth of files that load files."""
_HELP = """Known commands:
  help                            this list
  use <group>, use                take a group; the groups taken so far
  id, which                       the group taken
  joints, eef, vars               its joints, end effector, remembered states
  current, group_state            its present state; the same as a <group_state> of an SRDF
  record <name>, rand <name>      remember the present state, or a random one
  show, show <name>               remembered states, one of them
  x = y, x = [v1 v2 ...], x[i] = v  copy, set, change a remembered state
  delete <name>                   forget a state
  plan <name>, plan rand, plan    plan to a state, to a random one; the last plan
  execute                         execute the last plan
  go <name>, go rand              plan and move
  go up|down|left|right|forward|backward <dx>
  go <x> <y> <z> <roll> <pitch> <yaw> [approx]
  rotate <roll> <pitch> <yaw>     plan and move to an orientation
  pick <object>, place <object>
  stop, wait <seconds>
  planner <name>, time [seconds], tolerance [value]
  allow looking|replanning true|false
  constrain [name], database [host [port]]
  ground                          add a floor to the planning scene
  load [file], save [file], trace on|off
  quit"""


class MoveGroupInfoLevel:
    """Kinds of answers."""

    FAIL = 1
    WARN = 2
    SUCCESS = 3
    INFO = 4
    DEBUG = 5


_Answer = tuple[int, str]
_OK: _Answer = (MoveGroupInfoLevel.DEBUG, "OK")


class MoveGroupCommandInterpreter:
    """Executes commands, one a line, on the group that `use` took last."""

    DEFAULT_FILENAME = "move_group.cfg"
    GO_DIRS = _DIRECTIONS

    def __init__(self) -> None:
        """Connect to move_group."""
        self._groups: dict[str, MoveGroupCommander] = {}
        self._name = self._previous = ""
        self._scene = PlanningSceneInterface()
        self._robot = RobotCommander()
        self._last_plan: Any = None
        self._traces = False
        self._depth = 0

    def get_active_group(self) -> MoveGroupCommander | None:
        """Return the group taken last."""
        return self._groups.get(self._name)

    def get_loaded_groups(self) -> Iterable[str]:
        """Return the names of the groups taken so far."""
        return self._groups.keys()

    def execute(self, cmd: str) -> _Answer:
        """Execute a command; returns its kind and text."""
        words = cmd.split()
        if not words:
            return _OK
        words[0] = {"which": "id", "groups": "use"}.get(words[0].lower(), words[0].lower())
        try:
            general = {"use": self._use, "load": self._load, "save": self._save, "trace": self._trace}.get(words[0])
            if general is not None:
                return general(words[1:])
            group = self.get_active_group()
            if group is None:
                text = "No groups initialized yet. You must call the 'use' or the 'load' command first."
                return MoveGroupInfoLevel.INFO, f"{_HELP}\n\n{text}\n"
            return self._assign(group, cmd) or self._command(group, words)
        except MoveItCommanderException as error:
            return MoveGroupInfoLevel.WARN, f"{cmd.strip()}: {error}"
        except (ValueError, IndexError) as error:
            return MoveGroupInfoLevel.WARN, f"Unable to parse '{cmd.strip()}': {error}"

    # -- groups and files

    def _use(self, words: list[str]) -> _Answer:
        if not words:
            return MoveGroupInfoLevel.INFO, "\n".join(self._groups)
        name = self._previous if words[0] == "previous" else words[0]
        if not name:
            return _OK
        if name not in self._groups:
            try:
                self._groups[name] = MoveGroupCommander(name)
            except (MoveItCommanderException, RuntimeError) as error:
                return MoveGroupInfoLevel.FAIL, f"Initializing {name}: {error}"
        self._previous, self._name = self._name, name
        return _OK

    def _trace(self, words: list[str]) -> _Answer:
        if not words:
            return MoveGroupInfoLevel.INFO, f"trace is {'on' if self._traces else 'off'}"
        self._traces = words[0].lower() == "on"
        return _OK

    def _load(self, words: list[str]) -> _Answer:
        path = Path(words[0] if words else self.DEFAULT_FILENAME)
        path = path if path.is_file() else Path("cmd") / path
        if self._depth >= _MAX_DEPTH:
            return MoveGroupInfoLevel.WARN, f"Unable to load {path}: more than {_MAX_DEPTH} files load each other"
        self._depth += 1
        try:
            for number, line in enumerate(path.read_text().splitlines(), 1):
                if self._traces:
                    print(f"{path}:{number}:  {line}")
                level, text = self.execute(line.partition("#")[0])
                if level in (MoveGroupInfoLevel.FAIL, MoveGroupInfoLevel.WARN):
                    return MoveGroupInfoLevel.WARN, f"Error at {path}:{number}:  {line.strip()}\n{text}"
        except (OSError, UnicodeDecodeError) as error:
            return MoveGroupInfoLevel.WARN, f"Unable to load {path}: {error}"
        finally:
            self._depth -= 1
        return _OK

    def _save(self, words: list[str]) -> _Answer:
        path = Path(words[0] if words else self.DEFAULT_FILENAME)
        lines: list[str] = []
        for name, group in self._groups.items():
            lines.append(f"use {name}")
            for state, values in group.get_remembered_joint_values().items():
                lines.append(f"{state} = [{_numbers(values)}]")
        try:
            path.write_text("\n".join([*lines, ""]))
        except OSError as error:
            return MoveGroupInfoLevel.WARN, f"Unable to save {path}: {error}"
        return _OK

    # -- the group's commands

    def _assign(self, group: MoveGroupCommander, cmd: str) -> _Answer | None:
        text, known = cmd.strip(), group.get_remembered_joint_values()
        if (match := _VECTOR.fullmatch(text)) is not None:
            group.remember_joint_values(match[1], [float(number) for number in match[2].split()])
            return MoveGroupInfoLevel.SUCCESS, f"Remembered joint values [{match[2]}] under the name {match[1]}"
        if (match := _ELEMENT.fullmatch(text)) is not None and match[1] in known:
            values = list(known[match[1]])
            values[int(match[2])] = float(match[3])
            group.remember_joint_values(match[1], values)
            return MoveGroupInfoLevel.SUCCESS, f"Updated {match[1]}[{match[2]}]"
        if (match := _COPY.fullmatch(text)) is not None and match[2] in known:
            group.remember_joint_values(match[1], known[match[2]])
            return MoveGroupInfoLevel.SUCCESS, f"{match[1]} is now the same as {match[2]}"
        return None

    def _command(self, group: MoveGroupCommander, words: list[str]) -> _Answer:
        name, arguments = words[0], words[1:]
        if not arguments:
            return self._show(group, name)
        simple: dict[str, Callable[[str], object]] = {
            "planner": group.set_planner_id,
            "record": group.remember_joint_values,
            "rec": group.remember_joint_values,
            "rand": lambda state: group.remember_joint_values(state, group.get_random_joint_values()),
            "random": lambda state: group.remember_joint_values(state, group.get_random_joint_values()),
            "del": group.forget_joint_values,
            "delete": group.forget_joint_values,
            "tol": lambda value: group.set_goal_tolerance(float(value)),
            "tolerance": lambda value: group.set_goal_tolerance(float(value)),
            "time": lambda value: group.set_planning_time(float(value)),
            "wait": lambda value: time.sleep(float(value)),
            "constrain": group.set_path_constraints,
        }
        if name in simple and len(arguments) == 1:
            simple[name](arguments[0])
            return MoveGroupInfoLevel.SUCCESS, "OK"
        match name, arguments:
            case "show", [state]:
                known = group.get_remembered_joint_values()
                if state in known:
                    return MoveGroupInfoLevel.INFO, f"[{_numbers(known[state])}]"
                return MoveGroupInfoLevel.WARN, f"Joint values for {state} are not known"
            case "pick", [item]:
                return _told(
                    group.pick(item) == 1, f"Picked object {item}", f"Failed while trying to pick object {item}"
                )
            case "place", [item]:
                return _told(group.place(item), f"Placed object {item}", f"Failed while trying to place object {item}")
            case "allow", [what, value]:
                allow = group.allow_looking if what.startswith("look") else group.allow_replanning
                allow(value.lower() in ("1", "t", "true"))
                return _OK
            case "database", [host, *port]:
                group.set_constraints_database(host, int(port[0]) if port else 33829)
                return MoveGroupInfoLevel.WARN, f"Unable to connect to '{host}'"
            case "plan", [state]:
                return self._plan(group, state)
            case "rotate", [_, _, _]:
                group.set_rpy_target([float(number) for number in arguments])
                return _told(group.go(), "Rotation complete", f"Failed while rotating to {' '.join(arguments)}")
            case "go", _:
                self._last_plan = None
                return self._go(group, arguments)
            case _:
                return MoveGroupInfoLevel.WARN, f"Unknown command: '{' '.join(words)}'"

    def _show(self, group: MoveGroupCommander, name: str) -> _Answer:
        """Answer a command of one word."""
        info = MoveGroupInfoLevel.INFO
        known = group.get_remembered_joint_values()
        match name:
            case "stop":
                group.stop()
                return _OK
            case "execute":
                if self._last_plan is None:
                    return MoveGroupInfoLevel.WARN, "No motion plan computed"
                is_done = group.execute(self._last_plan)
                return _told(is_done, "Plan submitted for execution", "Failed to submit plan for execution")
            case "constrain":
                group.clear_path_constraints()
                return MoveGroupInfoLevel.SUCCESS, "Cleared path constraints"
            case "ground":
                self._add_ground()
                return info, "Added ground"
            case _:
                pass
        texts: dict[str, Callable[[], str]] = {
            "id": group.get_name,
            "help": self.get_help,
            "vars": lambda: f"[{' '.join(known)}]",
            "joints": lambda: "\n".join(f"{index} = {joint}" for index, joint in enumerate(group.get_joints())),
            "show": lambda: "\n".join(f"{state} = [{_numbers(values)}]" for state, values in known.items()),
            "current": lambda: _present_state(group),
            "group_state": lambda: _group_state(group),
            "eef": lambda: group.get_end_effector_link() or "There is no end effector defined",
            "database": lambda: "Not connected to a database",
            "plan": lambda: "No previous plan" if self._last_plan is None else str(self._last_plan),
            "tol": lambda: _tolerances(group),
            "time": lambda: str(group.get_planning_time()),
        }
        texts["tolerance"] = texts["tol"]
        if name in texts:
            return info, texts[name]()
        if name in known:
            return info, f"[{_numbers(known[name])}]"
        return MoveGroupInfoLevel.WARN, f"Unknown command: '{name}'"

    def _add_ground(self) -> None:
        root = self._robot.get_root_link()
        pose = list_to_pose_stamped([0.0, 0.0, -0.0501, 0.0, 0.0, 0.0], root)  # the root may stand on it
        pose.header.stamp = rospy.get_rostime()
        self._scene.attach_box(root, "ground", pose, (3.0, 3.0, 0.1))

    def _plan(self, group: MoveGroupCommander, state: str) -> _Answer:
        target = self._set_target(group, state)
        plan = group.plan()
        trajectory = plan[1] if isinstance(plan, tuple) else plan
        self._last_plan = trajectory if trajectory.joint_trajectory.points else None
        return _told(self._last_plan is not None, f"Planned to {target}", f"Failed while planning to {target}")

    def _go(self, group: MoveGroupCommander, arguments: list[str]) -> _Answer:
        if len(arguments) == 1:
            target = self._set_target(group, arguments[0])
            return _told(group.go(), f"Moved to {target}", f"Failed while moving to {target}")
        if len(arguments) == 2 and arguments[0] in _DIRECTIONS:
            name, distance = arguments[0], float(arguments[1])
            if not group.has_end_effector_link():
                return MoveGroupInfoLevel.WARN, f"No known end effector. Cannot move {name}"
            axis, factor = _DIRECTIONS[name]
            group.shift_pose_target(axis, factor * distance)
            return _told(group.go(), f"Moved {name} by {distance} m", f"Failed while moving {name}")
        pose = list_to_pose([float(number) for number in arguments[:6]])
        if arguments[6:] and arguments[6].startswith("approx"):
            group.set_joint_value_target(pose, True)
        else:
            group.set_pose_target(pose)
        return _told(group.go(), f"Moved to pose target\n{pose}\n", f"Failed while moving to pose \n{pose}\n")

    @staticmethod
    def _set_target(group: MoveGroupCommander, state: str) -> str:
        """Set a named state or a random one; returns its name."""
        if state not in ("rand", "random"):
            group.set_named_target(state)
            return state
        values = group.get_random_joint_values()
        group.set_joint_value_target(values)
        return f"random target [{_numbers(values)}]"

    def get_help(self) -> str:
        """Return the list of commands."""
        return _HELP

    def get_keywords(self) -> dict[str, list[str]]:
        """Return the commands, each with the words that may follow it."""
        group = self.get_active_group()
        states = [] if group is None else list(group.get_named_targets())
        nothing: list[str] = []
        keywords: dict[str, list[str]] = dict.fromkeys(_ALONE, nothing)
        keywords |= dict.fromkeys(("record", "show", "delete", "plan"), states)
        keywords["use"] = self._robot.get_group_names()
        keywords["allow"] = ["replanning", "looking"]
        keywords["go"] = ["up", "down", "left", "right", "backward", "forward", "random", *states]
        return keywords


def _numbers(values: Iterable[float]) -> str:
    return " ".join(map(str, values))


def _told(is_done: bool, success: str, failure: str) -> _Answer:
    return (MoveGroupInfoLevel.SUCCESS, success) if is_done else (MoveGroupInfoLevel.FAIL, failure)


def _present_state(group: MoveGroupCommander) -> str:
    text = f"joints = [{', '.join(map(str, group.get_current_joint_values()))}]"
    link = group.get_end_effector_link()
    if not link:
        return text
    return f"{text}\n\n{link} pose = [\n{group.get_current_pose()} ]\n{link} RPY = {group.get_current_rpy()}"


def _tolerances(group: MoveGroupCommander) -> str:
    joint, position, orientation = group.get_goal_tolerance()
    return f"Joint = {joint:0.6g}, Position = {position:0.6g}, Orientation = {orientation:0.6g}"


def _group_state(group: MoveGroupCommander) -> str:
    joints = zip(group.get_active_joints(), group.get_current_joint_values(), strict=False)
    lines = [f'        <joint name="{joint}" value="{value}"/>' for joint, value in joints]
    head = f'    <group_state name="custom_state" group="{group.get_name()}">'
    return "\n".join([head, *lines, "    </group_state>"])
