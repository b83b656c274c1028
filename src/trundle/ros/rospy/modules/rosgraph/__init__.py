"""The ROS graph: names, the master's API, addresses of the environment."""

import sys
from collections.abc import Sequence

from . import names as names
from .masterapi import Master, MasterError, MasterException, MasterFailure, is_online as is_master_online
from .rosenv import (
    ROS_HOSTNAME,
    ROS_IP,
    ROS_IPV6,
    ROS_MASTER_URI,
    ROS_NAMESPACE,
    get_master_uri,
)

__all__ = [
    "ROS_HOSTNAME",
    "ROS_IP",
    "ROS_IPV6",
    "ROS_MASTER_URI",
    "ROS_NAMESPACE",
    "Master",
    "MasterError",
    "MasterException",
    "MasterFailure",
    "get_master_uri",
    "is_master_online",
    "myargv",
]


def myargv(argv: Sequence[str] | None = None) -> list[str]:
    """Arguments without remappings."""
    return [argument for argument in (sys.argv if argv is None else argv) if names.REMAP not in argument]
