"""Which Python runs a script of ROS 1, whose first line may ask for one that has no rospy, or that is gone."""

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

from trundle.files import open_file

_IMPORTS_ROSPY = re.compile(rb"^\s*(?:import|from)\s+(?:rospy|roslib)\b", re.MULTILINE)
_WANTED = re.compile(rb"^\s*(?:import|from)\s+(rospy|roslib|\w+(?=\.(?:msg|srv)\b))", re.MULTILINE)
"""Modules that only a ROS has, or a workspace that was built."""
_ASKS = re.compile(rb"#!\s*(?:/usr/bin/env\s+(?=python)|(?=/))(python3?|\S*/python)\s*$", re.MULTILINE)
"""A first line that leaves open which Python is meant."""
_FIRST_LINE = re.compile(rb"#!\s*(?:/usr/bin/env\s+)?(\S+)")
_NOT_FOUND = re.compile(
    r"^\s*(?:ModuleNotFoundError|ImportError): No module named '?"
    r"(rospy|roslib|rosgraph|actionlib|cv_bridge|dynamic_reconfigure|message_filters|tf|tf2_\w+|\w+_(?:msgs|srvs))\b",
    re.MULTILINE,
)
_NO_ROSPY, _ASKING_S = 79, 10.0
_DEBIAN_PYTHON, _DEBIAN_MODULES = "/usr/bin/python3", "/usr/lib/python3/dist-packages"


def can_run(program: Path, env: Mapping[str, str]) -> bool:
    """Tell whether a program finds the modules of ROS it wants, rospy and messages."""
    wanted = {os.fsdecode(name) for name in _WANTED.findall(_beginning(program))}
    folders = [_DEBIAN_MODULES, *_python_path(env)]
    return all(any(os.path.isdir(os.path.join(folder, name)) for folder in folders) for name in wanted)


def lacks_rospy(program: Path, env: Mapping[str, str]) -> bool:
    """Tell whether a script imports rospy, and the Python that is to run it, which is asked, has none."""
    beginning = _beginning(program)
    written = _FIRST_LINE.match(beginning)
    if written is None or not _IMPORTS_ROSPY.search(beginning):
        return False
    python = shutil.which(next(iter(interpreter(program, env)), os.fsdecode(written[1])), path=env.get("PATH"))
    if python is None or not Path(python).name.startswith("python"):
        return False
    ask = f"import importlib.util as u, sys; sys.exit({_NO_ROSPY} if u.find_spec('rospy') is None else 0)"
    try:
        done = subprocess.run([python, "-c", ask], env=dict(env), capture_output=True, timeout=_ASKING_S, check=False)
    except (OSError, subprocess.TimeoutExpired):
        return False
    return done.returncode == _NO_ROSPY


def missing_ros_module(output: str) -> str | None:
    """The module of ROS for want of which a Python program died, as its last output says; None: it did not."""
    found = _NOT_FOUND.findall(output)
    return found[-1] if found else None


def missing_rospy_advice(module: str) -> str:
    """Say what can be done about a Python that has none of ROS' modules."""
    return (
        f"its Python has no {module}, which a ROS has, or a workspace that was built: where one is installed (Debian's "
        "python3-rospy is enough) its Python runs the node; Trundle brings no rospy yet, but runs the nodes of "
        "`trundle exec --list` without ROS"
    )


def interpreter(program: Path, env: Mapping[str, str]) -> list[str]:
    """Return what has to run a program; [] where its own first line says so well enough.

    A script that leaves open which Python it means gets Debian's if it imports rospy and only that one has it, as where
    Trundle's own virtual environment is active, and this one where there is no `python`.
    """
    beginning = _beginning(program)
    asked = _ASKS.match(beginning)
    if asked is None:
        return []
    found = shutil.which(os.fsdecode(asked[1]), path=env.get("PATH", os.defpath))
    if _IMPORTS_ROSPY.search(beginning) and _has_rospy(_DEBIAN_MODULES) and not any(map(_has_rospy, _python_path(env))):
        return [] if found is not None and _brings_rospy(Path(found)) else [_DEBIAN_PYTHON]
    return [] if found is not None else [sys.executable]


def _beginning(program: Path) -> bytes:
    try:
        with open_file(program) as file:
            return file.read(100_000)
    except OSError:
        return b""


def _brings_rospy(python: Path) -> bool:
    """Whether a Python is Debian's, or has a rospy of its own."""
    if python.parent.resolve() == Path(_DEBIAN_PYTHON).parent:  # a virtual environment's leads there, too
        return True
    return any(_has_rospy(folder) for folder in python.parent.parent.glob("lib/python3*/site-packages"))


def _python_path(env: Mapping[str, str]) -> list[str]:
    return [folder for folder in env.get("PYTHONPATH", "").split(os.pathsep) if folder]


def _has_rospy(folder: str | Path) -> bool:
    return Path(folder, "rospy").is_dir()
