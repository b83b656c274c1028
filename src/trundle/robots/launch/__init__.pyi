from .commands import CommandRunner as CommandRunner, XacroExpander as XacroExpander, resolve_params as resolve_params
from .packages import PackageFinder as PackageFinder
from .plan import (
    LaunchArgument as LaunchArgument,
    LaunchNode as LaunchNode,
    LaunchParam as LaunchParam,
    LaunchPlan as LaunchPlan,
    LaunchTest as LaunchTest,
    ParamCommand as ParamCommand,
    ParamStep as ParamStep,
    ParamType as ParamType,
    ParamValue as ParamValue,
)
from .reader import (
    ROS_VARIABLES as ROS_VARIABLES,
    read_arguments as read_arguments,
    read_launch as read_launch,
    read_launch_text as read_launch_text,
)
from .values import convert_value as convert_value
