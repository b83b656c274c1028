"""What a launch asks for: nodes, parameters and commands, resolved, with nothing started."""

from dataclasses import dataclass
from pathlib import Path
from typing import Literal, TypeAlias

from trundle.diagnostics import Source
from trundle.names import join_names

ParamValue: TypeAlias = bool | int | float | str | bytes | list["ParamValue"] | dict[str, "ParamValue"] | None
ParamType: TypeAlias = Literal["auto", "str", "int", "double", "bool", "yaml"]


@dataclass(frozen=True, slots=True, kw_only=True)
class ParamCommand:
    """A command whose output becomes a parameter's value: `<param command>`, not yet run."""

    line: str
    """As written, substituted; to be split as a shell would, and run without one."""
    type: ParamType
    """How the output is read."""
    at: Source


@dataclass(frozen=True, slots=True, kw_only=True)
class LaunchParam:
    """One parameter to set before any node starts."""

    name: str
    """Global name."""
    value: ParamValue | ParamCommand
    at: Source


@dataclass(frozen=True, slots=True, kw_only=True)
class LaunchNode:
    """One node to start."""

    name: str
    """Without namespace."""
    namespace: str
    """Global, without trailing slash; the root is '/'."""
    package: str
    type: str
    arguments: str = ""
    """As written, substituted; split as a shell would before use."""
    remappings: tuple[tuple[str, str], ...] = ()
    """(from, to) as written; an earlier pair with the same `from` is already gone."""
    env: tuple[tuple[str, str], ...] = ()
    """In order; the last one of a name wins."""
    output: Literal["log", "screen"] = "log"
    respawn: bool = False
    respawn_delay_s: float = 0.0
    required: bool = False
    cwd: Literal["ROS_HOME", "node"] = "ROS_HOME"
    launch_prefix: str = ""
    machine: str = ""
    address: str | None = ""
    """Of the machine it is to run on; empty: this one, None: there is no such machine."""
    at: Source

    @property
    def full_name(self) -> str:
        """Namespace and name: '/ns/name'."""
        return join_names(self.namespace, self.name)


@dataclass(frozen=True, slots=True, kw_only=True)
class LaunchTest:
    """A `<test>`: a node that only `trundle test` runs, and what it may take."""

    name: str
    """The attribute `test-name`."""
    node: LaunchNode
    time_limit_s: float = 60.0
    retries: int = 0


@dataclass(frozen=True, slots=True, kw_only=True)
class ParamStep:
    """A `<rosparam command="dump|delete">`: done before any parameter is set, in the order of the file."""

    command: Literal["dump", "delete"]
    name: str
    """Global name of the parameter or namespace."""
    file: str = ""
    """Where `dump` writes to."""
    at: Source


@dataclass(frozen=True, slots=True, kw_only=True)
class LaunchArgument:
    """An `<arg>` of the file that was asked for."""

    name: str
    default: str | None
    """None where the argument is required or fixed."""
    doc: str = ""
    required: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class LaunchPlan:
    """Everything that launch files ask for, in order."""

    nodes: tuple[LaunchNode, ...] = ()
    params: tuple[LaunchParam, ...] = ()
    clear_params: tuple[str, ...] = ()
    """Namespaces to delete before the parameters are set."""
    steps: tuple[ParamStep, ...] = ()
    arguments: tuple[LaunchArgument, ...] = ()
    files: tuple[Path, ...] = ()
    """Every launch file read, in order of first reading."""
    tests: tuple[LaunchTest, ...] = ()
