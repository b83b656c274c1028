"""Launch plan: nodes, parameters and commands, resolved but not started."""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal, TypeAlias

from trundle.base.diagnostics import Source
from trundle.robots.names import join_names

ParamValue: TypeAlias = bool | int | float | str | bytes | list["ParamValue"] | dict[str, "ParamValue"] | None
ParamType: TypeAlias = Literal["auto", "str", "int", "double", "bool", "yaml"]


@dataclass(frozen=True, slots=True, kw_only=True)
class ParamCommand:
    """A `<param command>`, not yet run; its output becomes the value."""

    line: str
    """Command line after substitution, to be split like a shell's and run without a shell."""
    type: ParamType
    """Type of the output."""
    at: Source


@dataclass(frozen=True, slots=True, kw_only=True)
class LaunchParam:
    """A parameter to set before any node starts."""

    name: str
    """Global name."""
    value: ParamValue | ParamCommand
    at: Source


@dataclass(frozen=True, slots=True, kw_only=True)
class LaunchNode:
    """A node to start."""

    name: str
    """Name without namespace."""
    namespace: str
    """Global, without trailing slash; the root is '/'."""
    package: str
    type: str
    arguments: str = ""
    """Arguments after substitution, to be split like a shell's."""
    remappings: tuple[tuple[str, str], ...] = ()
    """(from, to) as written; for equal `from`, only the last."""
    env: tuple[tuple[str, str], ...] = ()
    """(name, value) in order; the last of a name wins."""
    output: Literal["log", "screen"] = "log"
    respawn: bool = False
    respawn_delay_s: float = 0.0
    required: bool = False
    cwd: Literal["ROS_HOME", "node"] = "ROS_HOME"
    launch_prefix: str = ""
    machine: str = ""
    address: str | None = ""
    """Address of the node's machine; '' for this one, None if the machine is unknown."""
    at: Source

    @property
    def full_name(self) -> str:
        """Namespace and name: '/ns/name'."""
        return join_names(self.namespace, self.name)


@dataclass(frozen=True, slots=True, kw_only=True)
class LaunchTest:
    """A `<test>`: a node run by `trundle test` only, with its limits."""

    name: str
    """The attribute `test-name`."""
    node: LaunchNode
    time_limit_s: float = 60.0
    retries: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class ParamStep:
    """A `<rosparam command="dump|delete">`, executed in file order before any parameter is set."""

    command: Literal["dump", "delete"]
    name: str
    """Global name of the parameter or namespace."""
    file: str = ""
    """Output file of `dump`."""
    at: Source


@dataclass(frozen=True, slots=True, kw_only=True)
class LaunchArgument:
    """An `<arg>` of a launch file on the command line."""

    name: str
    default: str | None
    """None if the argument is required or fixed."""
    doc: str = ""
    required: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class LaunchPlan:
    """Contents of launch files, in order."""

    nodes: tuple[LaunchNode, ...] = ()
    params: tuple[LaunchParam, ...] = ()
    clear_params: tuple[str, ...] = ()
    """Namespaces to delete before the parameters are set."""
    steps: tuple[ParamStep, ...] = ()
    arguments: tuple[LaunchArgument, ...] = ()
    files: tuple[Path, ...] = ()
    """All launch files read, in order of first reading."""
    tests: tuple[LaunchTest, ...] = ()
