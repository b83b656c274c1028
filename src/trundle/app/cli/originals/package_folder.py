"""Folders given as `package/subfolder`, as in roscd and rosls."""

import os
from collections.abc import Mapping
from pathlib import Path

from trundle.base.diagnostics import UsageError

USAGE_SUFFIX = "PACKAGE[/FOLDER]"


def find_location(location: str, environment: Mapping[str, str]) -> Path:
    """Return the folder or file of a package; `log` is the log folder.

    Raises:
        UsageError: no such package.
    """
    from trundle.robots.packages import Packages

    name, _, subpath = location.partition("/")
    if name == "log":
        return log_parent(environment) / subpath
    packages = Packages(environment, start=Path.cwd())
    folder = packages.find_package(name)
    if folder is None:
        raise UsageError(f"No such package/stack '{name}'\n{packages.not_found_message(name)}")
    return folder / subpath


def log_parent(environment: Mapping[str, str]) -> Path:
    """Return the folder of all logs: ROS_LOG_DIR, or `log` in ROS_HOME or ~/.ros."""
    from trundle.live.launch.logs import ros_home

    return Path(environment.get("ROS_LOG_DIR") or ros_home(environment) / "log")


def workspace_folder(environment: Mapping[str, str]) -> Path:
    """Return ROS_WORKSPACE, or the first catkin workspace on CMAKE_PREFIX_PATH.

    Raises:
        UsageError: neither is set.
    """
    if workspace := environment.get("ROS_WORKSPACE"):
        return Path(workspace)
    for prefix in environment.get("CMAKE_PREFIX_PATH", "").split(os.pathsep):
        if prefix and os.path.isfile(os.path.join(prefix, ".catkin")):
            return Path(prefix)
    raise UsageError(
        "Neither ROS_WORKSPACE is set nor a catkin workspace is listed in CMAKE_PREFIX_PATH.  Please set "
        "ROS_WORKSPACE or source a catkin workspace to use roscd with no arguments."
    )
