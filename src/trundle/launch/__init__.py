"""Launch files: what enters is roslaunch XML, what leaves is a plan; nothing is started here."""

from .commands import CommandRunner, XacroExpander, resolve_params
from .packages import PackageFinder
from .plan import (
    LaunchArgument,
    LaunchNode,
    LaunchParam,
    LaunchPlan,
    LaunchTest,
    ParamCommand,
    ParamStep,
    ParamType,
    ParamValue,
)
from .reader import read_arguments, read_launch, read_launch_text

__all__ = [
    "CommandRunner",
    "LaunchArgument",
    "LaunchNode",
    "LaunchParam",
    "LaunchPlan",
    "LaunchTest",
    "PackageFinder",
    "ParamCommand",
    "ParamStep",
    "ParamType",
    "ParamValue",
    "XacroExpander",
    "read_arguments",
    "read_launch",
    "read_launch_text",
    "resolve_params",
]
