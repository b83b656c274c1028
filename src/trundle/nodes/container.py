"""Command lines that run the real node in a container, on the same graph."""

import shlex
from collections.abc import Mapping
from pathlib import Path

IMAGE = "ros:noetic-ros-base"
_MASTER = "http://localhost:11311"
_RUN = "docker run --rm -it --network host"


def package_in_container(package: str, type_name: str, env: Mapping[str, str]) -> str:
    """Command line for a node of a released package."""
    debian = f"ros-noetic-{package.replace('_', '-')}"
    inside = f"apt-get update && apt-get install -y {debian} && rosrun {package} {type_name}"
    return f"{_RUN} {_master(env)} {IMAGE} bash -c {shlex.quote(inside)}"


def source_in_container(folder: Path, package: str, type_name: str, env: Mapping[str, str]) -> str:
    """Command line that compiles a package, mounted read-only, and runs a node of it."""
    inside = (
        f"apt-get update && rosdep update && rosdep install -y --from-paths /ws/src; cd /ws && catkin_make && "
        f". devel/setup.sh && rosrun {package} {type_name}"
    )
    mount = shlex.quote(f"{folder}:/ws/src/{folder.name}:ro")
    return f"{_RUN} -v {mount} {_master(env)} {IMAGE} bash -c {shlex.quote(inside)}"


def _master(env: Mapping[str, str]) -> str:
    return f"-e ROS_MASTER_URI={shlex.quote(env.get('ROS_MASTER_URI', _MASTER))}"
