"""Packages of tests/data/sdk, compiled once by catkin_make, and their programs on a graph."""

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest
from tests.graphs import Graph

from trundle.base.diagnostics import UsageError
from trundle.ros.sdk import find_toolchain

WAIT_S = 120
SOURCE = Path(__file__).parents[2] / "data/sdk/src"


def require_compiler() -> None:
    try:
        find_toolchain(os.environ)
    except UsageError as error:
        pytest.skip(str(error))


@pytest.fixture(scope="session")
def workspace(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The compiled workspace, with one target more that cannot be compiled."""
    require_compiler()
    base = tmp_path_factory.mktemp("ws")
    shutil.copytree(SOURCE, base / "src")
    package = base / "src/cpp_nodes"
    (package / "src/plan.cpp").write_text("#include <moveit/no_such_header.h>\nint main() {}\n")
    cmake = package / "CMakeLists.txt"
    text = cmake.read_text().replace("roscpp std_msgs geometry_msgs", "roscpp std_msgs geometry_msgs no_such_arm")
    cmake.write_text(f"{text}\nfind_package(NoSuchLibrary REQUIRED)\nadd_executable(plan src/plan.cpp)\n")
    environment = {name: value for name, value in os.environ.items() if name != "CMAKE_PREFIX_PATH"}
    done = subprocess.run(
        [sys.executable, "-m", "trundle", "--as", "catkin_make", "-DCMAKE_BUILD_TYPE=None"],
        cwd=base,
        env={**environment, "PWD": str(base)},
        capture_output=True,
        text=True,
        check=False,
    )
    (base / "log").write_text(done.stdout + done.stderr)
    assert done.returncode == 1, done.stdout + done.stderr
    return base


class Running:
    """Started programs of the workspace."""

    def __init__(self, workspace: Path, uri: str) -> None:
        self.folder = workspace / "devel/lib"
        self.environment = {**os.environ, "ROS_MASTER_URI": uri, "ROS_PACKAGE_PATH": str(workspace / "src")}
        self.processes: list[subprocess.Popen[str]] = []

    def start(self, name: str, *arguments: str, package: str = "cpp_nodes") -> "subprocess.Popen[str]":
        process = subprocess.Popen(
            [str(self.folder / package / name), *arguments],
            env=self.environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        self.processes.append(process)
        return process


@pytest.fixture
def running(workspace: Path, graph: Graph) -> Iterator[Running]:
    programs = Running(workspace, graph.core.uri)
    yield programs
    for process in programs.processes:
        process.kill()
        process.communicate()
