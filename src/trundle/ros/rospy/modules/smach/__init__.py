"""State machines of states, containers and the data they share."""

from .concurrence import Concurrence
from .container import Container
from .exceptions import (
    InvalidConstructionError,
    InvalidStateError,
    InvalidTransitionError,
    InvalidUserCodeError,
    SmachError,
)
from .iterator import Iterator
from .log import logdebug, logerr, loginfo, logwarn, set_loggers
from .sequence import Sequence
from .state import CBState, State
from .state_machine import StateMachine
from .user_data import Remapper, UserData
from .util import CBInterface, cb_interface, has_smach_interface, is_shutdown, set_shutdown_check

__all__ = [
    "CBInterface",
    "CBState",
    "Concurrence",
    "Container",
    "InvalidConstructionError",
    "InvalidStateError",
    "InvalidTransitionError",
    "InvalidUserCodeError",
    "Iterator",
    "Remapper",
    "Sequence",
    "SmachError",
    "State",
    "StateMachine",
    "UserData",
    "cb_interface",
    "has_smach_interface",
    "is_shutdown",
    "logdebug",
    "logerr",
    "loginfo",
    "logwarn",
    "set_loggers",
    "set_shutdown_check",
]
