"""Checks of addresses, variables, folders and caches that a run uses."""

import os
import shutil
import socket
from collections.abc import Iterator, Mapping
from pathlib import Path

from trundle.live.graph import DEFAULT_PORT
from trundle.robots.meshes import cache_folder
from trundle.robots.packages import Packages
from trundle.ros import MasterProxy, RosError, host_and_port

from .check import Check

_PAGE_PORT = 8080
_LOOPBACK = "127.0.0.1"
_TIMEOUT_S = 2.0
_MIN_FREE_BYTES = 200 * 1024 * 1024


def environment_checks(environment: Mapping[str, str], start: Path) -> Iterator[Check]:
    """Yield findings on the network, ROS' variables, packages, models and disks.

    Args:
        environment: environment variables of the commands.
        start: working folder.
    """
    yield _master_port()
    yield _page_port()
    yield _master(environment)
    yield _host_name(environment)
    packages = Packages(environment, start=start)
    yield _check_path_variable(environment, "ROS_PACKAGE_PATH", f"{len(packages.ros_packages())} packages found")
    folders = packages.model_folders()
    models = sum(len(list(folder.glob("*/model.config"))) for folder in folders if os.path.isdir(folder))
    yield _check_path_variable(environment, "GAZEBO_MODEL_PATH", f"{models} models found, ~/.gazebo/models included")
    yield _check_writable("mesh cache", cache_folder(), "meshes are read again at each start")
    logs = Path(environment.get("ROS_LOG_DIR") or Path(environment.get("ROS_HOME") or Path.home() / ".ros") / "log")
    yield _check_writable("logs", logs, "launches keep no logs; set ROS_LOG_DIR")


def _is_free(port: int) -> bool:
    with socket.socket() as probe:
        if os.name == "posix":
            probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        try:
            probe.bind((_LOOPBACK, port))
        except OSError:
            return False
    return True


def _master_port() -> Check:
    name = f"port {DEFAULT_PORT}"
    if _is_free(DEFAULT_PORT):
        return Check(name=name, state="ok", found="free, for a ROS master")
    if _answers(f"http://{_LOOPBACK}:{DEFAULT_PORT}"):
        return Check(name=name, state="ok", found="a ROS master is there; launches join it")
    cost = "roscore and launches cannot start there; set ROS_MASTER_URI to another port"
    return Check(name=name, state="problem", found="taken, and not by a ROS master", cost=cost)


def _page_port() -> Check:
    is_free = _is_free(_PAGE_PORT)
    found = "free, for the page" if is_free else "taken; the page moves to the next free one"
    return Check(name=f"port {_PAGE_PORT}", state="ok", found=found)


def _answers(uri: str) -> bool:
    try:
        MasterProxy(uri, caller_id="/doctor", timeout_s=_TIMEOUT_S).call("getPid")
    except RosError:
        return False
    return True


def _master(environment: Mapping[str, str]) -> Check:
    uri = environment.get("ROS_MASTER_URI")
    name = "ROS_MASTER_URI"
    if not uri:
        return Check(name=name, state="ok", found=f"not set: http://localhost:{DEFAULT_PORT}")
    try:
        host, _ = host_and_port(uri)
        socket.getaddrinfo(host, None)
    except (RosError, OSError) as error:
        return Check(name=name, state="problem", found=uri, cost=f"no command finds the master: {error}")
    if _answers(uri):
        return Check(name=name, state="ok", found=f"{uri}, where a master answers")
    return Check(name=name, state="missing", found=f"{uri}, where no master answers", cost="roscore starts one")


def _host_name(environment: Mapping[str, str]) -> Check:
    """Check whether other machines can resolve the host name that nodes here advertise."""
    variable = next((name for name in ("ROS_HOSTNAME", "ROS_IP") if environment.get(name)), None)
    host = environment[variable] if variable else socket.gethostname()
    name = variable or "host name"
    try:
        addresses = sorted({str(info[4][0]) for info in socket.getaddrinfo(host, None)})
    except OSError as error:
        cost = f"nodes of other machines cannot reach those here ({error.strerror}); set ROS_IP to this one's address"
        return Check(name=name, state="problem" if variable else "missing", found=host, cost=cost)
    return Check(name=name, state="ok", found=f"{host} is {', '.join(addresses)}")


def _check_path_variable(environment: Mapping[str, str], variable: str, found: str) -> Check:
    entries = [entry for entry in environment.get(variable, "").split(os.pathsep) if entry]
    missing = [entry for entry in entries if not os.path.isdir(entry)]
    if missing:
        return Check(name=variable, state="problem", found=found, cost=f"no such folder: {', '.join(missing)}")
    return Check(
        name=variable, state="ok", found=f"{found}; {len(entries)} folders" if entries else f"not set; {found}"
    )


def _check_writable(name: str, folder: Path, cost: str) -> Check:
    existing = next((path for path in (folder, *folder.parents) if os.path.exists(path)), folder)
    if not os.access(existing, os.W_OK):
        return Check(name=name, state="problem", found=f"{folder} cannot be written", cost=cost)
    size = sum(path.stat().st_size for path in folder.rglob("*") if path.is_file() and not path.is_symlink())
    free = shutil.disk_usage(existing).free
    found = f"{folder}: {size / 1e6:.1f} MB, {free / 1e9:.1f} GB free"
    if free < _MIN_FREE_BYTES:
        return Check(name=name, state="problem", found=found, cost="the disk is nearly full")
    return Check(name=name, state="ok", found=found)
