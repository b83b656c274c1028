from .catalog import (
    BUILTIN_NODES as BUILTIN_NODES,
    CLIENTS as CLIENTS,
    KEYBOARDS as KEYBOARDS,
    ROSCPP as ROSCPP,
    WINDOWS as WINDOWS,
    WORLDS as WORLDS,
)
from .find import (
    BuiltinReplacement as BuiltinReplacement,
    Executable as Executable,
    MissingNode as MissingNode,
    find_node as find_node,
    program_names as program_names,
    same_named_programs as same_named_programs,
)
from .host import (
    BuiltinNode as BuiltinNode,
    Display as Display,
    NodeHost as NodeHost,
    Simulator as Simulator,
    Slider as Slider,
)
from .node_names import default_name as default_name
from .python_interpreter import (
    command_prefix as command_prefix,
    lacks_rospy as lacks_rospy,
    missing_ros_module as missing_ros_module,
    missing_rospy_advice as missing_rospy_advice,
    script_fault as script_fault,
)
from .run import run_builtin_node as run_builtin_node
