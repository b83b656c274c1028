"""Environment variables of the graph."""

import os
import sys
from collections.abc import Mapping, Sequence

ROS_MASTER_URI = "ROS_MASTER_URI"
ROS_IP = "ROS_IP"
ROS_IPV6 = "ROS_IPV6"
ROS_HOSTNAME = "ROS_HOSTNAME"
ROS_NAMESPACE = "ROS_NAMESPACE"
DEFAULT_MASTER_PORT = 11311
DEFAULT_MASTER_URI = f"http://localhost:{DEFAULT_MASTER_PORT}/"


def get_master_uri(env: Mapping[str, str] | None = None, argv: Sequence[str] | None = None) -> str:
    """URI of the master: `__master:=` on the command line, else ROS_MASTER_URI.

    Raises:
        ValueError: `__master` has no value, or more than one.
    """
    for argument in sys.argv if argv is None else argv:
        if argument.startswith("__master:="):
            value = argument.removeprefix("__master:=")
            if not value or ":=" in value:
                raise ValueError(f"__master remapping argument '{argument}' improperly specified")
            return value
    return (os.environ if env is None else env).get(ROS_MASTER_URI) or DEFAULT_MASTER_URI
