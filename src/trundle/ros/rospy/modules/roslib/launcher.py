"""Python path of rosbuild packages."""

import os
import re
import sys
from pathlib import Path

from trundle.base.files import read_text
from trundle.ros.rospy.package_folders import find_package

_DEPENDS = re.compile(r"<depend\s+(?:package|stack)\s*=\s*[\"']([\w.-]+)[\"']")
_PYTHON_PATH = re.compile(r"<python\s[^>]*path\s*=\s*[\"']([^\"']+)[\"']")
_MAX_BYTES = 1_000_000
_loaded: set[str] = set()


def load_manifest(package_name: str, bootstrap_version: str = "0.7") -> None:
    """Prepend `src` and `lib` of a rosbuild package, and of its dependencies, to the Python path.

    Modules of catkin packages are importable without it; packages that are not found are ignored.
    """
    del bootstrap_version
    waiting, folders = [package_name], list[str]()
    while waiting:
        name = waiting.pop(0)
        if name in _loaded:
            continue
        _loaded.add(name)
        folder = find_package(name)
        if folder is not None and os.path.isfile(folder / "manifest.xml"):
            text = _manifest(folder)
            waiting += _DEPENDS.findall(text)
            folders += _python_folders(folder, text)
    sys.path[:0] = [path for path in folders if path not in sys.path]


def _manifest(folder: Path) -> str:
    try:
        return read_text(folder / "manifest.xml", max_bytes=_MAX_BYTES)
    except OSError:
        return ""


def _python_folders(folder: Path, manifest: str) -> list[str]:
    exported = [part for path in _PYTHON_PATH.findall(manifest) for part in path.split(":")]
    if exported:
        return [part.replace("${prefix}", str(folder)) for part in exported]
    return [str(folder / name) for name in ("src", "lib") if os.path.isdir(folder / name)]
