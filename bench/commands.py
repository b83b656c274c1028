"""CPU time of `trundle check` and `trundle xacro`, whole processes, against ROS' tools.

The only peer that expands the smartcar is the xacro of ROS 1, 1.13.3: it allows macro calls without prefix, as the
file has them. It needs Debian's python3-roslaunch and is installed for the run. Today's xacro, of Trundle's own
environment, leaves those calls as they are, and check_urdf then finds no robot: it does less, and is shown as such.
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
"""Includes of the Husky for parts that it does not carry by default."""
_AMENT = """class PackageNotFoundError(KeyError): pass
def get_package_share_directory(name):
    return {0!r}[name]
"""


def run() -> list[Row]:
    """Measure CPU time of whole processes, alternating, in one run; a peer that cannot be installed is left out."""
    if not HUSKY.is_dir():
        return []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        smartcar, husky = _workspace(folder / "ws")
        env = {**os.environ, "ROS_PACKAGE_PATH": str(folder / "ws"), "PYTHONPATH": str(_ament(folder))}
        if env.pop("PYTHONDONTWRITEBYTECODE", None):  # Python keeps its byte code where it is installed for use
            env["PYTHONPYCACHEPREFIX"] = str(folder / "bytecode")
        ours, expanded = [str(Path(sys.executable).with_name("trundle"))], str(folder / "expanded.urdf")
        rows: list[Row] = []
        for xacro, who in _xacros(folder):
            if check_urdf := shutil.which("check_urdf"):
                theirs = [[xacro, str(smartcar), "-o", expanded], [check_urdf, expanded]]
                what = "check smartcar, start to exit"
                rows.append(_compared(what, [[*ours, "check", str(smartcar)]], theirs, f"{who} + check_urdf", env))
            theirs = [[xacro, str(husky), "-o", expanded]]
            rows.append(_compared("xacro husky, start to exit", [[*ours, "xacro", str(husky)]], theirs, who, env))
        return rows


def _workspace(folder: Path) -> tuple[Path, Path]:
    """The smartcar, with the package.xml that rospack asks for, and the Husky with the packages it names."""
    shutil.copytree(SHARED / "seeds/smartcar_description", folder / "smartcar_description")
    shutil.copytree(HUSKY / "husky_description", folder / "husky_description")
    for each in _NOT_IN_THE_COLLECTION:
        (folder / each).parent.mkdir(parents=True)
        (folder / each).write_text(_EMPTY)
    for package in folder.iterdir():
        if not (package / "package.xml").exists():
            (package / "package.xml").write_text(_MANIFEST.format(package.name))
    smartcar = folder / "smartcar_description/urdf/smartcar.urdf.xacro"
    return smartcar, folder / "husky_description/urdf/husky.urdf.xacro"


def _ament(folder: Path) -> Path:
    """Environment in which today's xacro finds the packages."""
    package = folder / "ament/ament_index_python"
    package.mkdir(parents=True)
    (package / "__init__.py").touch()
    places = {each.name: str(each) for each in (folder / "ws").iterdir()}
    (package / "packages.py").write_text(_AMENT.format(places))
    return package.parent


def _xacros(folder: Path) -> list[tuple[str, str]]:
    """Yield command and name of every xacro that is installed or can be."""
    found: list[tuple[str, str]] = []
    if today := shutil.which("xacro", path=str(Path(sys.executable).parent)):
        found.append((today, "xacro of today"))
    has_roslaunch = [_PYTHON, "-c", "import roslaunch, rospkg"]
    own = folder / "ros1"
    install = [str(own / "bin/pip"), "install", "--quiet", "--disable-pip-version-check", "xacro==1.13.3"]
    steps = (has_roslaunch, [_PYTHON, "-m", "venv", "--system-site-packages", str(own)], install)
    if Path(_PYTHON).exists() and all(
        subprocess.run(s, capture_output=True, check=False).returncode == 0 for s in steps
    ):
        found.insert(0, (str(own / "bin/xacro"), "xacro 1.13.3"))
    return found


def _compared(
    name: str, ours: Sequence[Sequence[str]], theirs: Sequence[Sequence[str]], peer: str, env: dict[str, str]
) -> Row:
    pairs = [(_seconds(ours, env), _seconds(theirs, env)) for _ in range(_RUNS + 1)][1:]  # the first warms up
    ratio = statistics.median(own / other for own, other in pairs)
    return Row(name, statistics.median(own for own, _ in pairs), "s of CPU", peer, ratio)


def _seconds(commands: Sequence[Sequence[str]], env: dict[str, str]) -> float:
    """CPU time [s], which other processes disturb less than wall time."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    for command in commands:
        subprocess.run(command, env=env, capture_output=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
