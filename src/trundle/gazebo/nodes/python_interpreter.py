"""Python interpreters for ROS 1 scripts; the interpreter of a shebang may lack rospy or no longer exist."""

import os
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

from trundle.base.extras import rospy_requirements
from trundle.base.files import open_file
from trundle.robots.packages import MANIFESTS, Packages
from trundle.ros.rospy.environment import RUN_PYTHON2
from trundle.ros.rospy.package_folders import package_modules
from trundle.ros.rospy.python2.cache import is_python2_file

_IMPORTS_ROSPY = re.compile(rb"^\s*(?:import|from)\s+(?:rospy|roslib)\b", re.MULTILINE)
_IMPORTS_ROS = re.compile(
    rb"^\s*(?:import|from)\s+(?:ros\w+|actionlib|genpy|tf|tf2_\w+|\w+_(?:msgs|srvs)|\w+\.(?:msg|srv))\b", re.MULTILINE
)
_IMPORTS_TRUNDLE = re.compile(rb"^\s*(?:import|from)\s+trundle\b", re.MULTILINE)
_IMPORTED_ROS_MODULE = re.compile(rb"^\s*(?:import|from)\s+(rospy|roslib|\w+(?=\.(?:msg|srv|cfg)\b))", re.MULTILINE)
"""Modules of a ROS installation or a built workspace."""
_IMPORTED_MODULE = re.compile(rb"^[ \t]*(?:import|from)[ \t]+(\w+)", re.MULTILINE)
_GENERIC_SHEBANG = re.compile(
    rb"#!\s*(?:/usr/bin/env\s+(?=python)|(?=/))(python(?:2(?:\.\d)?|3)?|\S*/python(?:2(?:\.\d)?)?)\s*$", re.MULTILINE
)
"""Shebangs that do not name one specific Python."""
_SHEBANG = re.compile(rb"#!\s*(?:/usr/bin/env\s+)?(\S+)")
_MISSING_MODULE = re.compile(
    r"^\s*(?:ModuleNotFoundError|ImportError): No module named '?"
    r"(rospy|roslib|rosgraph|actionlib|cv_bridge|dynamic_reconfigure|message_filters|tf|tf2_\w+|\w+_(?:msgs|srvs))\b",
    re.MULTILINE,
)
_EXIT_WITHOUT_ROSPY = 79
_DEBIAN_PYTHON, _DEBIAN_MODULES = "/usr/bin/python3", "/usr/lib/python3/dist-packages"


def can_run(program: Path, env: Mapping[str, str]) -> bool:
    """Return True if the ROS modules that a program imports (rospy, messages) are installed."""
    names = {os.fsdecode(name) for name in _IMPORTED_ROS_MODULE.findall(_read_beginning(program))}
    folders = [_DEBIAN_MODULES, *_python_path(env)]
    return all(any(os.path.isdir(os.path.join(folder, name)) for folder in folders) for name in names)


def lacks_rospy(program: Path, env: Mapping[str, str]) -> bool:
    """Return True if a script imports rospy and its Python lacks it; runs that Python to check."""
    beginning = _read_beginning(program)
    shebang = _SHEBANG.match(beginning)
    if shebang is None or not _IMPORTS_ROSPY.search(beginning):
        return False
    command = interpreter(program, env)
    if len(command) > 1:
        return False  # a Python 2 script is translated, and this process's Python runs it
    python = shutil.which(next(iter(command), os.fsdecode(shebang[1])), path=env.get("PATH"))
    if python is None or not Path(python).name.startswith("python"):
        return False
    code = f"import importlib.util as u, sys; sys.exit({_EXIT_WITHOUT_ROSPY} if u.find_spec('rospy') is None else 0)"
    try:
        process = subprocess.run([python, "-c", code], env=dict(env), capture_output=True, check=False)
    except OSError:
        return False
    return process.returncode == _EXIT_WITHOUT_ROSPY


def missing_ros_module(output: str) -> str | None:
    """Return the missing ROS module in the last output of a Python program, if any."""
    names = _MISSING_MODULE.findall(output)
    return names[-1] if names else None


def missing_rospy_advice(module: str) -> str:
    """Return advice for a Python without a ROS module."""
    return (
        f"its Python has no {module}; `#!/usr/bin/env python3` as its first line runs it with Trundle's Python, and "
        f"`python -m pip install {rospy_requirements()}` brings ROS' packages to its own"
    )


def interpreter(program: Path, env: Mapping[str, str]) -> list[str]:
    """Return the interpreter command for a program; [] if its shebang suffices.

    A script with a generic Python shebang that is in a ROS package or imports ROS runs with a Python that has rospy:
    the shebang's, else Debian's. This process's Python runs the script if rospy is not installed, if modules or
    messages are of a workspace that is not built, if there is no `python`, and if the script imports trundle. This
    process's Python also translates and runs Python 2 programs, unless PYTHONPATH has a ROS.
    """
    beginning = _read_beginning(program)
    shebang = _GENERIC_SHEBANG.match(beginning)
    if shebang is None:
        return []
    if _IMPORTS_TRUNDLE.search(beginning):
        return [sys.executable]
    has_rospy = any(map(_has_rospy, _python_path(env)))
    if not has_rospy and not shebang[1].endswith(b"3") and is_python2_file(program):
        return [sys.executable, str(RUN_PYTHON2)]
    python = shutil.which(os.fsdecode(shebang[1]), path=env.get("PATH", os.defpath))
    if not has_rospy and (_IMPORTS_ROS.search(beginning) or _is_in_package(program)):
        is_debian = python is None or _is_debian_python(Path(python))
        if python is not None and not is_debian and _has_installed_rospy(Path(python)):
            return []
        if not _has_rospy(_DEBIAN_MODULES) or _needs_workspace(program, env):
            return [sys.executable]
        return [] if python is not None and is_debian else [_DEBIAN_PYTHON]
    return [] if python is not None else [sys.executable]


def is_script(program: Path) -> bool:
    """Return True if a file begins with a shebang."""
    return _SHEBANG.match(_read_beginning(program)) is not None


def script_fault(program: Path) -> str | None:
    """Return the reason why the system cannot run a script, and the remedy; None if it can."""
    if not os.access(program, os.X_OK):
        return f"is not executable; it is run nevertheless, as after: chmod +x {shlex.quote(str(program))}"
    if _has_crlf(program):
        return f"has the line ends of Windows; it is run nevertheless, as after: dos2unix {shlex.quote(str(program))}"
    return None


def command_prefix(program: Path, env: Mapping[str, str]) -> list[str]:
    """Return the arguments before a program's name on its command line; [] if the system runs it directly."""
    command = interpreter(program, env)
    if command or not is_script(program) or (os.access(program, os.X_OK) and not _has_crlf(program)):
        return command
    program_, *options = _read_beginning(program).partition(b"\n")[0].strip()[2:].decode(errors="replace").split()
    return options if Path(program_).name == "env" and options else [program_, *options]


def _has_crlf(program: Path) -> bool:
    return _read_beginning(program).partition(b"\n")[0].endswith(b"\r")


def _read_beginning(program: Path) -> bytes:
    try:
        with open_file(program) as file:
            return file.read(100_000)
    except OSError:
        return b""


def _needs_workspace(program: Path, env: Mapping[str, str]) -> bool:
    """Return True if a program imports modules that Debian's Python lacks and the packages around it have."""
    if not can_run(program, env):
        return True
    names = _imported_modules(program) - sys.stdlib_module_names
    folders = [_DEBIAN_MODULES, *_python_path(env), str(program.parent)]
    missing = {name for name in names if not any(map(os.path.exists, _module_files(name, folders)))}
    if not missing:
        return False
    packages = Packages(env, start=program).ros_packages().items()
    return any(module in missing for name, folder in packages for module, _ in package_modules(name, folder))


def _imported_modules(program: Path) -> set[str]:
    """Return the modules that a program and the files in its folder import."""
    neighbours = [path for path in program.parent.glob("*.py") if path != program]
    return {
        os.fsdecode(name) for file in (program, *neighbours) for name in _IMPORTED_MODULE.findall(_read_beginning(file))
    }


def _is_in_package(program: Path) -> bool:
    return any(os.path.isfile(folder / name) for folder in program.parents for name in MANIFESTS)


def _module_files(name: str, folders: Iterable[str]) -> Iterator[str]:
    for folder in folders:
        yield from (os.path.join(folder, name), os.path.join(folder, f"{name}.py"))


def _is_debian_python(python: Path) -> bool:
    return python.parent.resolve() == Path(_DEBIAN_PYTHON).parent  # the target of a virtual environment's link, too


def _has_installed_rospy(python: Path) -> bool:
    """Return True if rospy is installed in a Python's environment."""
    return any(_has_rospy(folder) for folder in python.parent.parent.glob("lib/python3*/site-packages"))


def _python_path(env: Mapping[str, str]) -> list[str]:
    return [folder for folder in env.get("PYTHONPATH", "").split(os.pathsep) if folder]


def _has_rospy(folder: str | Path) -> bool:
    return Path(folder, "rospy").is_dir()
