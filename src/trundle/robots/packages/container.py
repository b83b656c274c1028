"""Docker command lines that run the original program in a container, on the same graph."""

import shlex
from collections.abc import Mapping
from pathlib import Path

IMAGE = "ros:noetic-ros-base"
_MASTER = "http://localhost:11311"
_ADDRESSES = ("ROS_MASTER_URI", "ROS_IP", "ROS_HOSTNAME")
_RUN = "docker run --rm -it --network host"


def package_in_container(package: str, command: str, env: Mapping[str, str]) -> str:
    """Return the command line that runs a command of a released package."""
    script = f"apt-get update && apt-get install -y {_debian(package)} && {command}"
    return f"{_RUN} {_master(env)} {IMAGE} bash -c {shlex.quote(script)}"


def source_in_container(folder: Path, command: str, env: Mapping[str, str], *, needs: str = "") -> str:
    """Return the command line that compiles a package, mounted read-only, and runs a command with it.

    Args:
        folder: package folder.
        command: command to run in the built workspace.
        env: environment with the master's address.
        needs: released package that the command needs, too; empty: none.
    """
    install = f" && apt-get install -y {_debian(needs)}" if needs else ""
    script = (
        f"apt-get update{install} && rosdep update && rosdep install -y --from-paths /ws/src; "
        f"cd /ws && catkin_make && . devel/setup.sh && {command}"
    )
    mount = shlex.quote(f"{folder}:/ws/src/{folder.name}:ro")
    return f"{_RUN} -v {mount} {_master(env)} {IMAGE} bash -c {shlex.quote(script)}"


def _debian(package: str) -> str:
    return f"ros-noetic-{package.replace('_', '-')}"


def _master(env: Mapping[str, str]) -> str:
    variables = {"ROS_MASTER_URI": _MASTER, **{name: env[name] for name in _ADDRESSES if env.get(name)}}
    return " ".join(f"-e {name}={shlex.quote(value)}" for name, value in variables.items())
