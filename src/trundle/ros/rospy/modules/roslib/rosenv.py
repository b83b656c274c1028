"""Environment variables."""

import os
from collections.abc import Mapping, Sequence

import rosgraph
from rosgraph.roslogging import get_log_dir as get_log_dir

ROS_ROOT = "ROS_ROOT"
ROS_MASTER_URI = "ROS_MASTER_URI"
ROS_PACKAGE_PATH = "ROS_PACKAGE_PATH"
ROS_HOME = "ROS_HOME"


def get_ros_root(required: bool = True, env: Mapping[str, str] | None = None) -> str | None:
    """ROS_ROOT."""
    del required
    return (os.environ if env is None else env).get(ROS_ROOT)


def get_ros_package_path(required: bool = False, env: Mapping[str, str] | None = None) -> str | None:
    """ROS_PACKAGE_PATH."""
    del required
    return (os.environ if env is None else env).get(ROS_PACKAGE_PATH)


def get_master_uri(
    required: bool = True, env: Mapping[str, str] | None = None, argv: Sequence[str] | None = None
) -> str | None:
    """URI of the master."""
    del required
    return rosgraph.get_master_uri(env, argv)


def get_ros_home(env: Mapping[str, str] | None = None) -> str:
    """ROS_HOME, or ~/.ros."""
    return (os.environ if env is None else env).get(ROS_HOME) or os.path.join(os.path.expanduser("~"), ".ros")
