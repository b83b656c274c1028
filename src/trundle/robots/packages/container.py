"""Command lines that run the real program in a container, on the same graph."""

import shlex
from collections.abc import Mapping
from pathlib import Path

IMAGE = "ros:noetic-ros-base"
_MASTER = "http://localhost:11311"
_ADDRESSES = ("ROS_MASTER_URI", "ROS_IP", "ROS_HOSTNAME")
_RUN = "docker run --rm -it --network host"


def package_in_container(package: str, command: str, env: Mapping[str, str]) -> str:
    """Command line that runs a command of a released package."""
    inside = f"apt-get update && apt-get install -y {_debian(package)} && {command}"
    return f"{_RUN} {_master(env)} {IMAGE} bash -c {shlex.quote(inside)}"


def source_in_container(folder: Path, command: str, env: Mapping[str, str], *, needs: str = "") -> str:
    """Command line that compiles a package, mounted read-only, and runs a command with it.

    Args:
        folder: of the package.
        command: run in the built workspace.
        env: names the master.
        needs: released package that the command needs.
    """
    installed = f" && apt-get install -y {_debian(needs)}" if needs else ""
    inside = (
        f"apt-get update{installed} && rosdep update && rosdep install -y --from-paths /ws/src; "
        f"cd /ws && catkin_make && . devel/setup.sh && {command}"
    )
    mount = shlex.quote(f"{folder}:/ws/src/{folder.name}:ro")
    return f"{_RUN} -v {mount} {_master(env)} {IMAGE} bash -c {shlex.quote(inside)}"


def _debian(package: str) -> str:
    return f"ros-noetic-{package.replace('_', '-')}"


def _master(env: Mapping[str, str]) -> str:
    own = {"ROS_MASTER_URI": _MASTER, **{name: env[name] for name in _ADDRESSES if env.get(name)}}
    return " ".join(f"-e {name}={shlex.quote(value)}" for name, value in own.items())
