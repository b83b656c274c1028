"""Python interpreters for ROS 1 scripts, whose shebang may name one that lacks rospy or no longer exists."""

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
_WANTED = re.compile(rb"^\s*(?:import|from)\s+(rospy|roslib|\w+(?=\.(?:msg|srv|cfg)\b))", re.MULTILINE)
"""Modules of a ROS installation or a built workspace."""
_IMPORTED = re.compile(rb"^[ \t]*(?:import|from)[ \t]+(\w+)", re.MULTILINE)
_ASKS = re.compile(
    rb"#!\s*(?:/usr/bin/env\s+(?=python)|(?=/))(python(?:2(?:\.\d)?|3)?|\S*/python(?:2(?:\.\d)?)?)\s*$", re.MULTILINE
)
"""Shebangs that do not name one specific Python."""
_FIRST_LINE = re.compile(rb"#!\s*(?:/usr/bin/env\s+)?(\S+)")
_NOT_FOUND = re.compile(
    r"^\s*(?:ModuleNotFoundError|ImportError): No module named '?"
    r"(rospy|roslib|rosgraph|actionlib|cv_bridge|dynamic_reconfigure|message_filters|tf|tf2_\w+|\w+_(?:msgs|srvs))\b",
    re.MULTILINE,
)
_NO_ROSPY = 79
_DEBIAN_PYTHON, _DEBIAN_MODULES = "/usr/bin/python3", "/usr/lib/python3/dist-packages"


def can_run(program: Path, env: Mapping[str, str]) -> bool:
    """True if the ROS modules that a program imports (rospy, messages) are installed."""
    wanted = {os.fsdecode(name) for name in _WANTED.findall(_beginning(program))}
    folders = [_DEBIAN_MODULES, *_python_path(env)]
    return all(any(os.path.isdir(os.path.join(folder, name)) for folder in folders) for name in wanted)


def lacks_rospy(program: Path, env: Mapping[str, str]) -> bool:
    """True if a script imports rospy and its Python lacks it; runs that Python to check."""
    beginning = _beginning(program)
    written = _FIRST_LINE.match(beginning)
    if written is None or not _IMPORTS_ROSPY.search(beginning):
        return False
    command = interpreter(program, env)
    if len(command) > 1:
        return False  # translated, and run with ours
    python = shutil.which(next(iter(command), os.fsdecode(written[1])), path=env.get("PATH"))
    if python is None or not Path(python).name.startswith("python"):
        return False
    ask = f"import importlib.util as u, sys; sys.exit({_NO_ROSPY} if u.find_spec('rospy') is None else 0)"
    try:
        done = subprocess.run([python, "-c", ask], env=dict(env), capture_output=True, check=False)
    except OSError:
        return False
    return done.returncode == _NO_ROSPY


def missing_ros_module(output: str) -> str | None:
    """Missing ROS module named in the last output of a Python program, if any."""
    found = _NOT_FOUND.findall(output)
    return found[-1] if found else None


def missing_rospy_advice(module: str) -> str:
    """Advice for a Python without ROS modules."""
    return (
        f"its Python has no {module}; `#!/usr/bin/env python3` as its first line runs it with Trundle's Python, and "
        f"`python -m pip install {rospy_requirements()}` brings ROS' packages to its own"
    )


def interpreter(program: Path, env: Mapping[str, str]) -> list[str]:
    """Return the interpreter command for a program; [] if its shebang suffices.

    A script with a generic Python shebang, in a ROS package or with imports of ROS, gets a Python with rospy: its own,
    else Debian's. Without an installed rospy, for modules and messages of a workspace that is not built, and where
    there is no `python`, it gets this process's Python, as does a program that imports trundle. A Python 2 program is
    translated, and run by this process's Python, unless a ROS of its own is on PYTHONPATH.
    """
    beginning = _beginning(program)
    asked = _ASKS.match(beginning)
    if asked is None:
        return []
    if _IMPORTS_TRUNDLE.search(beginning):
        return [sys.executable]
    has_rospy = any(map(_has_rospy, _python_path(env)))
    if not has_rospy and not asked[1].endswith(b"3") and is_python2_file(program):
        return [sys.executable, str(RUN_PYTHON2)]
    found = shutil.which(os.fsdecode(asked[1]), path=env.get("PATH", os.defpath))
    if not has_rospy and (_IMPORTS_ROS.search(beginning) or _is_in_package(program)):
        is_debians = found is None or _is_debians(Path(found))
        if found is not None and not is_debians and _brings_rospy(Path(found)):
            return []
        if not _has_rospy(_DEBIAN_MODULES) or _needs_workspace(program, env):
            return [sys.executable]
        return [] if found is not None and is_debians else [_DEBIAN_PYTHON]
    return [] if found is not None else [sys.executable]


def is_script(program: Path) -> bool:
    """True if a file begins with a line that names its interpreter."""
    return _FIRST_LINE.match(_beginning(program)) is not None


def script_fault(program: Path) -> str | None:
    """Return why the system would not run a script, and what mends it; None: it runs it."""
    if not os.access(program, os.X_OK):
        return f"is not executable; it is run nevertheless, as after: chmod +x {shlex.quote(str(program))}"
    if _has_crlf(program):
        return f"has the line ends of Windows; it is run nevertheless, as after: dos2unix {shlex.quote(str(program))}"
    return None


def start_words(program: Path, env: Mapping[str, str]) -> list[str]:
    """Return the words before a program's name on its command line; [] if the system runs it as it is."""
    words = interpreter(program, env)
    if words or not is_script(program) or (os.access(program, os.X_OK) and not _has_crlf(program)):
        return words
    first, *more = _beginning(program).partition(b"\n")[0].strip()[2:].decode(errors="replace").split()
    return more if Path(first).name == "env" and more else [first, *more]


def _has_crlf(program: Path) -> bool:
    return _beginning(program).partition(b"\n")[0].endswith(b"\r")


def _beginning(program: Path) -> bytes:
    try:
        with open_file(program) as file:
            return file.read(100_000)
    except OSError:
        return b""


def _needs_workspace(program: Path, env: Mapping[str, str]) -> bool:
    """True if a program imports what Debian's Python lacks, and Trundle's finds in the packages around it."""
    if not can_run(program, env):
        return True
    names = _imported(program) - sys.stdlib_module_names
    folders = [_DEBIAN_MODULES, *_python_path(env), str(program.parent)]
    lacking = {name for name in names if not any(map(os.path.exists, _module_files(name, folders)))}
    if not lacking:
        return False
    packages = Packages(env, start=program).ros_packages().items()
    return any(module in lacking for name, folder in packages for module, _ in package_modules(name, folder))


def _imported(program: Path) -> set[str]:
    """Return the modules that a program imports, or the files beside it."""
    beside = [each for each in program.parent.glob("*.py") if each != program]
    return {os.fsdecode(name) for file in (program, *beside) for name in _IMPORTED.findall(_beginning(file))}


def _is_in_package(program: Path) -> bool:
    return any(os.path.isfile(folder / name) for folder in program.parents for name in MANIFESTS)


def _module_files(name: str, folders: Iterable[str]) -> Iterator[str]:
    for folder in folders:
        yield from (os.path.join(folder, name), os.path.join(folder, f"{name}.py"))


def _is_debians(python: Path) -> bool:
    return python.parent.resolve() == Path(_DEBIAN_PYTHON).parent  # also the target of a virtual environment's link


def _brings_rospy(python: Path) -> bool:
    """True if a Python has a rospy of its own."""
    return any(_has_rospy(folder) for folder in python.parent.parent.glob("lib/python3*/site-packages"))


def _python_path(env: Mapping[str, str]) -> list[str]:
    return [folder for folder in env.get("PYTHONPATH", "").split(os.pathsep) if folder]


def _has_rospy(folder: str | Path) -> bool:
    return Path(folder, "rospy").is_dir()
