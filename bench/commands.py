"""CPU time of `trundle check` and `trundle xacro`, whole processes, against ROS' tools.

The only peer that expands the smartcar is xacro 1.13.3 of ROS 1: it allows macro calls without a prefix, as in the
file. It needs Debian's python3-roslaunch and is installed for the run. The current xacro, in Trundle's
environment, does not expand those calls, so that check_urdf finds no robot: it does less work, and the row says so.
"""

import os
import resource
import shutil
import statistics
import subprocess
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

from bench.table import Row

SHARED = Path(__file__).parents[2] / "shared"
HUSKY = SHARED / "corpus/repos/husky+husky"
_RUNS = 7
_PYTHON = "/usr/bin/python3"
_MANIFEST = """<package format="2"><name>{0}</name><version>0.0.0</version><description>{0}</description>
<maintainer email="bench@example.org">bench</maintainer><license>BSD</license></package>"""
_EMPTY = '<robot name="stand_in" xmlns:xacro="http://ros.org/wiki/xacro"/>'
_NOT_IN_THE_COLLECTION = (
    "fath_pivot_mount_description/urdf/lockmount.urdf.xacro",
    "flir_camera_description/urdf/flir_blackflys.urdf.xacro",
    "lms1xx/urdf/sick_lms1xx.urdf.xacro",
    "velodyne_description/urdf/VLP-16.urdf.xacro",
)
"""Includes of the Husky for optional parts."""
_AMENT = """class PackageNotFoundError(KeyError): pass
def get_package_share_directory(name):
    return {0!r}[name]
"""


def run() -> list[Row]:
    """Measure the CPU time of alternating processes; skip a peer that cannot be installed."""
    if not HUSKY.is_dir():
        return []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        smartcar, husky = _workspace(folder / "ws")
        env = {**os.environ, "ROS_PACKAGE_PATH": str(folder / "ws"), "PYTHONPATH": str(_ament(folder))}
        if env.pop("PYTHONDONTWRITEBYTECODE", None):  # an installed program has its byte code cached
            env["PYTHONPYCACHEPREFIX"] = str(folder / "bytecode")
        trundle, expanded = [str(Path(sys.executable).with_name("trundle"))], str(folder / "expanded.urdf")
        rows: list[Row] = []
        for xacro, peer in _xacros(folder):
            if check_urdf := shutil.which("check_urdf"):
                commands = [[xacro, str(smartcar), "-o", expanded], [check_urdf, expanded]]
                name = "check smartcar, start to exit"
                rows.append(_compare(name, [[*trundle, "check", str(smartcar)]], commands, f"{peer} + check_urdf", env))
            commands = [[xacro, str(husky), "-o", expanded]]
            rows.append(_compare("xacro husky, start to exit", [[*trundle, "xacro", str(husky)]], commands, peer, env))
        return rows


def _workspace(folder: Path) -> tuple[Path, Path]:
    """Write the smartcar with a package.xml for rospack, and the Husky with its packages; return their files."""
    shutil.copytree(SHARED / "seeds/smartcar_description", folder / "smartcar_description")
    shutil.copytree(HUSKY / "husky_description", folder / "husky_description")
    for path in _NOT_IN_THE_COLLECTION:
        (folder / path).parent.mkdir(parents=True)
        (folder / path).write_text(_EMPTY)
    for package in folder.iterdir():
        if not (package / "package.xml").exists():
            (package / "package.xml").write_text(_MANIFEST.format(package.name))
    smartcar = folder / "smartcar_description/urdf/smartcar.urdf.xacro"
    return smartcar, folder / "husky_description/urdf/husky.urdf.xacro"


def _ament(folder: Path) -> Path:
    """Write a module with which the current xacro finds the packages; return its folder."""
    package = folder / "ament/ament_index_python"
    package.mkdir(parents=True)
    (package / "__init__.py").touch()
    paths = {path.name: str(path) for path in (folder / "ws").iterdir()}
    (package / "packages.py").write_text(_AMENT.format(paths))
    return package.parent


def _xacros(folder: Path) -> list[tuple[str, str]]:
    """Return program and name of every xacro that is installed or can be installed."""
    programs: list[tuple[str, str]] = []
    if current := shutil.which("xacro", path=str(Path(sys.executable).parent)):
        programs.append((current, "current xacro"))
    has_roslaunch = [_PYTHON, "-c", "import roslaunch, rospkg"]
    environment = folder / "ros1"
    install = [str(environment / "bin/pip"), "install", "--quiet", "--disable-pip-version-check", "xacro==1.13.3"]
    steps = (has_roslaunch, [_PYTHON, "-m", "venv", "--system-site-packages", str(environment)], install)
    if Path(_PYTHON).exists() and all(
        subprocess.run(s, capture_output=True, check=False).returncode == 0 for s in steps
    ):
        programs.insert(0, (str(environment / "bin/xacro"), "xacro 1.13.3"))
    return programs


def _compare(
    name: str, trundle: Sequence[Sequence[str]], other: Sequence[Sequence[str]], peer: str, env: dict[str, str]
) -> Row:
    pairs = [(_seconds(trundle, env), _seconds(other, env)) for _ in range(_RUNS + 1)][1:]  # the first warms up
    ratio = statistics.median(trundle_s / other_s for trundle_s, other_s in pairs)
    return Row(name, statistics.median(trundle_s for trundle_s, _ in pairs), "s of CPU", peer, ratio)


def _seconds(commands: Sequence[Sequence[str]], env: dict[str, str]) -> float:
    """Return the CPU time of commands [s], which depends less on other processes than wall time."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    for command in commands:
        subprocess.run(command, env=env, capture_output=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
