"""The published launch files beside the checkout, and roslaunch 1.15.9's result of each."""

import gzip
import json
import re
import shlex
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from trundle.base.diagnostics import Diagnostics
from trundle.robots.launch import LaunchNode, LaunchPlan, ParamCommand, read_launch
from trundle.robots.packages import Packages

_ANONYMOUS = re.compile(r"_[A-Za-z0-9.-]+_\d+_\d+|_[a-z0-9-]*_\d+_\d{10,}")


@dataclass(frozen=True, slots=True)
class Case:
    """One file, with the arguments it was given."""

    root: Path
    row: dict[str, Any]

    @property
    def file(self) -> Path:
        return self.root / self.row["file"]

    @property
    def reference(self) -> dict[str, Any]:
        return json.loads(gzip.decompress((self.root / self.row["ref"]).read_bytes()))

    def read(self, report: Diagnostics) -> LaunchPlan:
        """Read it as Trundle does.

        Raises:
            DescriptionError: it is refused.
        """
        repository = self.root / "repos" / self.row["repo"]
        env = {**self.row["env"], "ROS_PACKAGE_PATH": f"{repository}:{self.root / 'repos'}", "HOME": "/nowhere"}
        words = [word.split(":=", 1) for word in self.row["argv"]]
        arguments = {name: value for name, value in words if value}
        packages = Packages(env, start=self.file)
        return read_launch(self.file, packages=packages, report=report, arguments=arguments, env=env)


def cases(root: Path) -> list[Case]:
    return [Case(root, row) for row in json.loads((root / "manifest.json").read_text())["launch"]]


def differences(case: Case, plan: LaunchPlan) -> list[str]:
    """Differences of the plan from roslaunch's."""
    theirs = case.reference
    found: list[str] = []

    def compare(what: str, a: object, b: object) -> None:
        if a != b:
            found.append(f"{what}: {a!r} is {b!r} in roslaunch")

    root = str(case.root)
    compare("files", {_here(str(f), root) for f in plan.files}, {_here(f, root) for f in theirs["files"]})
    compare("clear", sorted(plan.clear_params), sorted(n.rstrip("/") for n in theirs["clear_params"]))
    for what, ours, refs in (
        ("nodes", plan.nodes, theirs["nodes"]),
        ("tests", [test.node for test in plan.tests], theirs["tests"]),
    ):
        mine = sorted((_node(node, root) for node in ours), key=repr)
        compare(f"number of {what}", len(mine), len(refs))
        for a, b in zip(mine, sorted((_reference_node(n, root) for n in refs), key=repr), strict=False):
            for key in a:
                compare(f"{a['full']} {key}", a[key], b[key])
    values = {_plain(p.name, root): p.value for p in plan.params}
    wanted = {_plain(k, root): v for k, v in theirs["params"].items()}
    compare("parameters", sorted(set(values) - set(wanted)), sorted(set(wanted) - set(values)))
    commands = [command["argv"] for command in theirs["commands"]]
    for name, value in values.items():
        if isinstance(value, ParamCommand):
            argv = [_plain(word, root) for word in shlex.split(value.line)]
            known = [[_plain(word, root) for word in command] for command in commands]
            if argv not in known and argv[1:] not in [command[1:] for command in known]:
                found.append(f"{name}: command {argv} is not one of {known}")
        elif name in wanted and not _same(value, wanted[name], root):
            found.append(f"{name}: {value!r} is {wanted[name]!r} in roslaunch")
    return found


def _node(node: LaunchNode, root: str) -> dict[str, object]:
    return {
        "full": _plain(node.full_name, root),
        "pkg": node.package,
        "type": node.type,
        "args": _plain(node.arguments, root),
        "remap": [(_plain(a, root), _plain(b, root)) for a, b in node.remappings],
        "env": [(a, _plain(b, root)) for a, b in node.env],
        "output": node.output,
        "respawn": (node.respawn, node.respawn_delay_s),
        "required": node.required,
        "cwd": node.cwd,
        "prefix": node.launch_prefix,
        "machine": node.machine,
    }


def _reference_node(node: dict[str, Any], root: str) -> dict[str, object]:
    return {
        "full": _plain(node["namespace"] + node["name"], root),
        "pkg": node["pkg"],
        "type": node["type"],
        "args": _plain(node["args"], root),
        "remap": [(_plain(a, root), _plain(b, root)) for a, b in node["remap"]],
        "env": [(a, _plain(b, root)) for a, b in node["env"]],
        "output": node["output"] or "log",
        "respawn": (node["respawn"], node["respawn_delay"]),
        "required": node["required"],
        "cwd": {"node": "node"}.get(node["cwd"] or "", "ROS_HOME"),
        "prefix": node["launch_prefix"] or "",
        "machine": node["machine"] or "",
    }


def _same(ours: object, theirs: object, root: str) -> bool:
    if isinstance(theirs, dict) and ("$blob" in theirs or "$other" in theirs):
        return True
    if isinstance(ours, str) and isinstance(theirs, str):
        return _plain(ours, root) == _plain(theirs, root)
    return ours == theirs and type(ours) is type(theirs)


def _here(file: str, root: str) -> str:
    """Name of a file; Debian's copy of roslaunch shadowed the corpus' own when the references were made."""
    return _plain(file, root).replace("/usr/share/roslaunch/", "CORPUS/repos/ros+ros_comm/tools/roslaunch/")


def _plain(text: str, root: str) -> str:
    """Text without parts that depend on the machine or the run."""
    return _ANONYMOUS.sub("_ANON", re.sub(r"(?<![\w/])dev/repos", "CORPUS/repos", text.replace(root, "CORPUS")))
