"""Advice for a Python 2 program that Python 3 ran without translation."""

import os
import shlex
import sys
from pathlib import Path

from trundle.ros.rospy.environment import RUN_PYTHON2

from .cache import changes, is_python2_file

_PYTHON2_ERRORS = (SyntaxError, NameError, ModuleNotFoundError, AttributeError, TypeError)
"""Errors that Python 3 raises for Python 2's syntax and names."""


def python2_advice(error: BaseException) -> str | None:
    """Return how to run the program that raised an error; None if neither the program nor the module is Python 2."""
    program = sys.argv[0] if getattr(sys, "argv", None) else ""
    if not isinstance(error, _PYTHON2_ERRORS) or not os.path.isfile(program):
        return None
    files = (program, error.filename if isinstance(error, SyntaxError) else None)
    python2_file = next((file for file in files if file and file.endswith(".py") and _is_python2(file)), None)
    if python2_file is None:
        return None
    words = shlex.join([*_command(Path(os.path.realpath(program))), *sys.argv[1:]])
    return f"trundle: {python2_file} is Python 2; this runs it, translated: {words}"


def _is_python2(file: str) -> bool:
    try:
        changes(file)  # raises for a program that is invalid in both versions
    except (OSError, SyntaxError):
        return False
    return is_python2_file(file)


def _command(program: Path) -> list[str]:
    from trundle.robots.packages import Packages

    packages = Packages(os.environ, start=program).ros_packages().items()
    package = next((name for name, folder in packages if program.is_relative_to(os.path.realpath(folder))), None)
    if package is None:
        return [sys.executable, str(RUN_PYTHON2), str(program)]
    return ["trundle", "exec", package, program.name]
