"""`trundle check` of a launch file; commands are listed, not run."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import cast

from trundle.base.diagnostics import Diagnostics, Source
from trundle.base.drawing.tree import TreeNode
from trundle.robots.launch import LaunchPlan, ParamCommand, read_launch
from trundle.robots.load_input import Piped
from trundle.robots.packages import Packages

from ..missing_nodes import report_missing_nodes


@dataclass(frozen=True, slots=True)
class LaunchFindings:
    """Nodes and parameters of a launch file."""

    plan: LaunchPlan

    def as_json(self) -> dict[str, object]:
        """Return the contents, as `check --json` prints them."""
        return {
            "kind": "launch",
            "nodes": [
                {
                    "name": node.full_name,
                    "package": node.package,
                    "type": node.type,
                    "args": node.arguments,
                    "remaps": [list(pair) for pair in node.remappings],
                    "required": node.required,
                    "respawn": node.respawn,
                }
                for node in self.plan.nodes
            ],
            "params": {
                param.name: {"command": param.value.line}
                if isinstance(param.value, ParamCommand)
                else _json_value(param.value)
                for param in self.plan.params
            },
        }

    def trees(self) -> list[TreeNode]:
        """Return no trees: robots are in other files."""
        return []

    def sentence(self) -> str:
        """Return the counts of nodes and parameters, on one line."""
        commands = sum(isinstance(param.value, ParamCommand) for param in self.plan.params)
        by_command = f", {commands} of them by a command" if commands else ""
        return f"a launch of {len(self.plan.nodes)} nodes with {len(self.plan.params)} parameters{by_command}"


def check_launch(
    file: str, environment: Mapping[str, str], *, packages: Packages, report: Diagnostics, piped: Piped | None = None
) -> LaunchFindings:
    """Read a launch file, or the text of a pipe; report nodes that cannot be found.

    Raises:
        DescriptionError: the file cannot be read.
    """
    if piped is not None:
        text = piped.data.decode(errors="replace")
        files, texts = [], [(piped.name, text)]
    else:
        packages = packages.around(Path(file))
        for variables in packages.hook_variables().values():
            environment = {**environment, **variables}
        files, texts = [Path(file)], []
    plan = read_launch(
        files,
        packages=packages,
        report=report,
        env=environment,
        texts=texts,
        check_readable=packages.check_readable,
    )
    packages.warn_of_finds(report, Source(file))
    report_missing_nodes(plan.nodes, packages, environment, report)
    return LaunchFindings(plan)


def _json_value(value: object) -> object:
    """Return the JSON form of a parameter's value: bytes become hex, nan and inf text."""
    match value:
        case bytes():
            return value.hex()
        case float() if not math.isfinite(value):
            return str(value)
        case list():
            return [_json_value(item) for item in cast("list[object]", value)]
        case dict():
            return {str(key): _json_value(item) for key, item in cast("dict[object, object]", value).items()}
        case _:
            return value
