"""Stand-ins for stock executables: nodes that launch files name, run in this process."""

from .catalog import CLIENTS, ROSCPP, STAND_INS, WINDOWS, WORLDS
from .find import Executable, Missing, Replacement, find_node, namesakes, program_names
from .host import Display, Host, Simulator, Slider, StandIn
from .node_names import default_name
from .run import run_stand_in
from .scripts import interpreter, lacks_rospy, module_of_ros, without_rospy

__all__ = [
    "CLIENTS",
    "ROSCPP",
    "STAND_INS",
    "WINDOWS",
    "WORLDS",
    "Display",
    "Executable",
    "Host",
    "Missing",
    "Replacement",
    "Simulator",
    "Slider",
    "StandIn",
    "default_name",
    "find_node",
    "interpreter",
    "lacks_rospy",
    "module_of_ros",
    "namesakes",
    "program_names",
    "run_stand_in",
    "without_rospy",
]
