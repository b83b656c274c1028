"""Clients and servers of ROS actions."""

from actionlib_msgs.msg import GoalID, GoalStatus, GoalStatusArray

from .action_client import ActionClient
from .action_server import ActionServer
from .client_goal_handle import ClientGoalHandle
from .comm_state import CommState, TerminalState, get_name_of_constant
from .comm_state_machine import CommStateMachine
from .exceptions import ActionException
from .goal_id_generator import GoalIDGenerator
from .goal_manager import GoalManager
from .server_goal_handle import ServerGoalHandle
from .simple_action_client import SimpleActionClient, SimpleGoalState
from .simple_action_server import SimpleActionServer

__all__ = [
    "ActionClient",
    "ActionException",
    "ActionServer",
    "ClientGoalHandle",
    "CommState",
    "CommStateMachine",
    "GoalID",
    "GoalIDGenerator",
    "GoalManager",
    "GoalStatus",
    "GoalStatusArray",
    "ServerGoalHandle",
    "SimpleActionClient",
    "SimpleActionServer",
    "SimpleGoalState",
    "TerminalState",
    "get_name_of_constant",
]
