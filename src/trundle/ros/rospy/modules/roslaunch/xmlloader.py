"""Reading launch files."""

import os
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.robots.description import expand_xacro
from trundle.robots.launch import LaunchNode, LaunchPlan, read_launch, resolve_params
from trundle.robots.names import parse_arguments
from trundle.robots.packages import Packages

from .contents import ROSLaunchConfig
from .core import Param, RLException
from .machine import Machine
from .node import Node, Test

_TEXT = "string"
"""File name of a text that was not read from a file."""


class XmlParseException(RLException):
    """A launch file is invalid."""


class XmlLoader:
    """Reads launch files into a ROSLaunchConfig."""

    def __init__(self, resolve_anon: bool = True, args_only: bool = False) -> None:
        """Create a loader; the arguments have no effect."""
        del resolve_anon, args_only
        self.ignore_unset_args = False

    def load(
        self,
        filename: str,
        ros_config: ROSLaunchConfig,
        core: bool = False,
        argv: Sequence[str] | None = None,
        verbose: bool = True,
    ) -> None:
        """Read a file.

        Args:
            filename: file's path.
            ros_config: configuration to which the contents are added.
            core: add the nodes as the master's nodes.
            argv: arguments ('name:=value'); default: sys.argv.
            verbose: print each added item.

        Raises:
            XmlParseException: the file is invalid.
        """
        if verbose:
            print(f"... loading XML file [{filename}]")
        ros_config.add_roslaunch_file(filename)
        self._load(ros_config, argv, core=core, verbose=verbose, file=Path(filename))

    def load_string(
        self, xml_text: str | bytes, ros_config: ROSLaunchConfig, core: bool = False, verbose: bool = True
    ) -> None:
        """Read a text.

        Raises:
            XmlParseException: the text is invalid.
        """
        if verbose:
            print("... loading XML")
        text = xml_text.decode() if isinstance(xml_text, bytes) else xml_text
        self._load(ros_config, None, core=core, verbose=verbose, text=text)

    def _load(
        self,
        config: ROSLaunchConfig,
        argv: Sequence[str] | None,
        *,
        core: bool,
        verbose: bool,
        file: Path | None = None,
        text: str = "",
    ) -> None:
        options = parse_arguments(sys.argv[1:] if argv is None else argv)
        packages, report = Packages(os.environ, start=file or Path.cwd()), Diagnostics()
        try:
            plan = read_launch(
                [] if file is None else [file],
                packages=packages,
                report=report,
                arguments=dict(options.remappings),
                env=os.environ,
                texts=[] if file is not None else [(_TEXT, text)],
                namespace=options.namespace or os.environ.get("ROS_NAMESPACE") or "/",
            )
            params = resolve_params(
                plan,
                report,
                expand_xacro=lambda path, arguments: expand_xacro(path, arguments, packages=packages, report=report),
                env=os.environ,
            )
        except DescriptionError as error:
            if not self.ignore_unset_args:
                raise XmlParseException(str(error)) from None
            return
        for param in params:
            if param.value is not None:
                config.add_param(Param(param.name, param.value), verbose=verbose)
        for included in plan.files:
            if included not in (file, Path(_TEXT)):
                config.add_roslaunch_file(str(included))
        _add(plan, config, core=core, verbose=verbose)
        for warning in report.warnings:
            config.add_config_error(str(warning))


def _add(plan: LaunchPlan, config: ROSLaunchConfig, *, core: bool, verbose: bool) -> None:
    for name in plan.clear_params:
        config.add_clear_param(name if name.endswith("/") else f"{name}/")
    for node in (*plan.nodes, *(test.node for test in plan.tests)):
        if node.machine and node.address:
            config.add_machine(Machine(node.machine, node.address), verbose=verbose)
    for node in plan.nodes:
        launched = Node(
            respawn=node.respawn,
            respawn_delay=node.respawn_delay_s,
            output="screen" if node.output == "screen" else None,
            required=node.required,
            **_common(node),
        )
        config.add_node(launched, core=core, verbose=verbose)
    for test in plan.tests:
        config.add_test(
            Test(test.name, time_limit=test.time_limit_s, retry=test.retries, **_common(test.node)), verbose=verbose
        )


def _common(node: LaunchNode) -> dict[str, Any]:
    return {
        "package": node.package,
        "node_type": node.type,
        "name": node.name,
        "namespace": node.namespace,
        "machine_name": node.machine,
        "args": node.arguments,
        "remap_args": [[old, new] for old, new in node.remappings],
        "env_args": node.env,
        "cwd": "node" if node.cwd == "node" else None,
        "launch_prefix": node.launch_prefix,
        "filename": str(node.at.file),
    }
