"""The development kit's roscpp against Debian's: one program, compiled with both, in alternation on one master.

Debian's needs libroscpp-dev and libsensor-msgs-dev; without it, and without a compiler, there are no rows.
"""

import os
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from bench.graph import age, as_row, first_message, flow
from bench.table import Row
from trundle.base.diagnostics import UsageError
from trundle.ros.sdk import find_toolchain

_END = Path(__file__).parent / "ros_end.cc"
_TWIST, _IMAGE = "geometry_msgs/Twist", "sensor_msgs/Image"
_PAIRS = 5
_BUILDS = 3
_PEER = "Debian's roscpp"
_DEBIAN_HEADERS = (Path("/usr/include/ros/ros.h"), Path("/usr/include/sensor_msgs/Image.h"))
_MANIFEST = """<package format="2"><name>{0}</name><version>0.1.0</version><description>{0}</description>
<maintainer email="bench@example.org">bench</maintainer><license>BSD</license>
<buildtool_depend>catkin</buildtool_depend><depend>roscpp</depend></package>"""
_CMAKE = """cmake_minimum_required(VERSION 3.0.2)
project({0})
find_package(catkin REQUIRED COMPONENTS roscpp std_msgs geometry_msgs sensor_msgs)
catkin_package()
include_directories(${{catkin_INCLUDE_DIRS}})
add_executable(end src/end.cpp)
target_link_libraries(end ${{catkin_LIBRARIES}})
"""
_TEN_LINES = """#include <ros/ros.h>
#include <std_msgs/String.h>
int main(int argc, char** argv) {
  ros::init(argc, argv, "talker");
  ros::NodeHandle node;
  ros::Publisher publisher = node.advertise<std_msgs::String>("chatter", 1);
  std_msgs::String message;
  for (ros::Rate rate(10); ros::ok(); rate.sleep()) publisher.publish(message);
  return 0;
}
"""


def run() -> list[Row]:
    """Compile, and measure pairs of runs."""
    try:
        find_toolchain(os.environ)
    except UsageError:
        return []
    with TemporaryDirectory() as name:
        folder = Path(name)
        ours = _compile(folder / "kit", _END.read_text())
        ends = [[str(ours)]]
        if debian := _debian(folder / "debian"):
            ends.append([str(debian)])
        return [*_messages(ends), *_builds(folder)]


def _messages(ends: Sequence[Sequence[str]]) -> list[Row]:
    def row(name: str, unit: str, measure: Callable[[Sequence[str]], float]) -> Row:
        return as_row(f"C++, {name}", unit, [[measure(end) for end in ends] for _ in range(_PAIRS)], _PEER)

    return [
        row("Twist, unlimited queue", "messages/s", lambda end: flow(end, _TWIST, 200_000).rate),
        row("Twist, CPU of both ends", "µs", lambda end: flow(end, _TWIST, 200_000).cpu_us),
        row("Twist at 1 kHz, 99th percentile of ages", "ms", age),
        row("Image 320x240, queue_size 10", "messages/s", lambda end: flow(end, _IMAGE, 6000, 10).rate),
        row("start of a node to its first message", "s", first_message),
    ]


def _builds(folder: Path) -> list[Row]:
    """Seconds of catkin_make for a node of ten lines: of a new workspace, and after a change; the kit is compiled."""
    cold: list[float] = []
    warm: list[float] = []
    for index in range(_BUILDS):
        base = folder / f"build{index}"
        start = time.perf_counter()
        _compile(base, f"{_TEN_LINES}// {index}\n", ccache=False)
        cold.append(time.perf_counter() - start)
        (base / "src/bench_end/src/end.cpp").write_text(_TEN_LINES.replace("Rate rate(10)", "Rate rate(20)"))
        start = time.perf_counter()
        _catkin_make(base, ccache=False)
        warm.append(time.perf_counter() - start)
    rows = (("of a new workspace", cold), ("after a change", warm))
    return [
        as_row(f"C++, catkin_make of ten lines, {what}", "s", [[value] for value in values], "")
        for what, values in rows
    ]


def _compile(base: Path, source: str, *, ccache: bool = True) -> Path:
    """Write a workspace with one program and compile it with the kit; return the program."""
    package = base / "src/bench_end"
    (package / "src").mkdir(parents=True)
    (package / "package.xml").write_text(_MANIFEST.format("bench_end"))
    (package / "CMakeLists.txt").write_text(_CMAKE.format("bench_end"))
    (package / "src/end.cpp").write_text(source)
    _catkin_make(base, ccache=ccache)
    return base / "devel/lib/bench_end/end"


def _catkin_make(base: Path, *, ccache: bool) -> None:
    left_out = ("CMAKE_PREFIX_PATH", "ROS_PACKAGE_PATH", *(() if ccache else ("CMAKE_CXX_COMPILER_LAUNCHER",)))
    kept = {name: value for name, value in os.environ.items() if name not in left_out}
    command = [sys.executable, "-m", "trundle", "--as", "catkin_make"]
    done = subprocess.run(
        command, cwd=base, env={**kept, "PWD": str(base)}, capture_output=True, text=True, check=False
    )
    if done.returncode:
        raise RuntimeError(done.stdout + done.stderr)


def _debian(program: Path) -> Path | None:
    """Compile the program with Debian's roscpp; None: it is not installed."""
    if not all(path.exists() for path in _DEBIAN_HEADERS) or not (compiler := shutil.which("g++")):
        return None
    flags = ["pkg-config", "--cflags", "--libs", "roscpp"]
    done = subprocess.run(flags, capture_output=True, text=True, check=False)
    if done.returncode:
        return None
    command = [compiler, "-O3", "-DNDEBUG", "-w", str(_END), "-o", str(program), *done.stdout.split(), "-lpthread"]
    subprocess.run(command, check=True, capture_output=True)
    return program
