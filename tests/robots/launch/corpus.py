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
    expected = case.reference
    found_differences: list[str] = []

    def compare(label: str, a: object, b: object) -> None:
        if a != b:
            found_differences.append(f"{label}: {a!r} is {b!r} in roslaunch")

    root = str(case.root)
    compare("files", {_here(str(f), root) for f in plan.files}, {_here(f, root) for f in expected["files"]})
    compare("clear", sorted(plan.clear_params), sorted(n.rstrip("/") for n in expected["clear_params"]))
    for label, actual, refs in (
        ("nodes", plan.nodes, expected["nodes"]),
        ("tests", [test.node for test in plan.tests], expected["tests"]),
    ):
        mine = sorted((_node(node, root) for node in actual), key=repr)
        compare(f"number of {label}", len(mine), len(refs))
        for a, b in zip(mine, sorted((_reference_node(n, root) for n in refs), key=repr), strict=False):
            for key in a:
                compare(f"{a['full']} {key}", a[key], b[key])
    values = {_plain(p.name, root): p.value for p in plan.params}
    expected_params = {_plain(k, root): v for k, v in expected["params"].items()}
    compare("parameters", sorted(set(values) - set(expected_params)), sorted(set(expected_params) - set(values)))
    commands = [command["argv"] for command in expected["commands"]]
    for name, value in values.items():
        if isinstance(value, ParamCommand):
            argv = [_plain(word, root) for word in shlex.split(value.line)]
            plain_commands = [[_plain(word, root) for word in command] for command in commands]
            if argv not in plain_commands and argv[1:] not in [command[1:] for command in plain_commands]:
                found_differences.append(f"{name}: command {argv} is not one of {plain_commands}")
        elif name in expected_params and not _same(value, expected_params[name], root):
            found_differences.append(f"{name}: {value!r} is {expected_params[name]!r} in roslaunch")
    return found_differences


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


def _same(actual: object, expected: object, root: str) -> bool:
    if isinstance(expected, dict) and ("$blob" in expected or "$other" in expected):
        return True
    if isinstance(actual, str) and isinstance(expected, str):
        return _plain(actual, root) == _plain(expected, root)
    return actual == expected and type(actual) is type(expected)


def _here(file: str, root: str) -> str:
    """Name of a file; Debian's copy of roslaunch shadowed the corpus' own when the references were made."""
    return _plain(file, root).replace("/usr/share/roslaunch/", "CORPUS/repos/ros+ros_comm/tools/roslaunch/")


def _plain(text: str, root: str) -> str:
    """Text without parts that depend on the machine or the run."""
    return _ANONYMOUS.sub("_ANON", re.sub(r"(?<![\w/])dev/repos", "CORPUS/repos", text.replace(root, "CORPUS")))
