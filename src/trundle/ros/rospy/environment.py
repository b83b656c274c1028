"""Environment of child processes in which ROS' Python packages can be imported."""

import os
import sys
import sysconfig
from collections.abc import Iterable, Mapping
from pathlib import Path

SITE = Path(__file__).parent / "site"
"""Folder whose `sitecustomize.py` appends the finder."""

LIBRARIES = "TRUNDLE_LIBRARIES"
"""Environment variable: version tag and folder of this Python's libraries, for others of the same version."""
RUN_PYTHON2 = Path(__file__).parent / "python2/run.py"
"""Script that translates and runs a Python 2 script."""


def python_libraries() -> str:
    """Value of `LIBRARIES` for this Python."""
    return f"{sys.implementation.cache_tag}:{sysconfig.get_path('purelib')}"


def with_finder(env: Mapping[str, str], package_folders: Iterable[Path] = ()) -> dict[str, str]:
    """Copy of an environment whose Python processes can import ROS' packages, and find the given ones.

    Args:
        env: environment; its PYTHONPATH and ROS_PACKAGE_PATH stay in effect.
        package_folders: folders of ROS packages, for ROS_PACKAGE_PATH where it is not set.
    """
    path = [folder for folder in env.get("PYTHONPATH", "").split(os.pathsep) if folder and folder != str(SITE)]
    result = {**env, "PYTHONPATH": os.pathsep.join([str(SITE), *path]), LIBRARIES: python_libraries()}
    folders = os.pathsep.join(map(str, package_folders))
    if folders and not env.get("ROS_PACKAGE_PATH"):
        result["ROS_PACKAGE_PATH"] = folders
    return result
