"""catkin_make: the devel space, what a shell gets from it, and the names of what is not compiled."""

import os
import re
import socket
import subprocess
import sys
from pathlib import Path

import pytest

from trundle.app.cli import main
from trundle.ros.catkin import NewPackage, create_package

_ORIGINAL = Path("/usr/bin/catkin_make")
_VARIABLES = ("CMAKE_PREFIX_PATH", "LD_LIBRARY_PATH", "PATH", "PYTHONPATH", "ROS_PACKAGE_PATH")


_DRIVE = """#include <ros/ros.h>
int main(int argc, char** argv) {
  ros::init(argc, argv, "drive");
  ros::NodeHandle own("~");
  ROS_INFO("%s drives at %d", ros::this_node::getName().c_str(), own.param("speed", 0));
}
"""


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A workspace with a package of Python and one of C++ that needs it."""
    for variable in (*_VARIABLES[:1], "ROS_PACKAGE_PATH", "TRUNDLE_SHELL"):
        monkeypatch.delenv(variable, raising=False)
    base = tmp_path / "ws"
    for name, needs in (("alpha", ("zeta", "roscpp")), ("zeta", ("rospy",))):
        list(create_package(base / "src", NewPackage(name=name, dependencies=needs)))
    with (base / "src/alpha/CMakeLists.txt").open("a") as file:
        file.write("add_executable(drive src/drive.cpp)\nadd_library(wheel_plugin SHARED src/wheel.cc)\n")
    (base / "src/zeta/msg").mkdir()
    (base / "src/zeta/msg/Speed.msg").write_text("float64 x\n")
    monkeypatch.setenv("PWD", str(base))
    monkeypatch.chdir(base)
    return base


def _make(*arguments: str) -> int:
    return main(["--as", "catkin_make", *arguments])


def test_a_workspace_gets_its_devel_space(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert _make() == 0

    printed = capsys.readouterr()
    lines = printed.out.splitlines()
    spaces = ("Source src", "Build build", "Devel devel", "Install install")
    named = (f"{name} space: {workspace / folder}" for name, folder in map(str.split, spaces))
    assert lines[:5] == [f"Base path: {workspace}", *named]
    assert "-- ~~  traversing 2 packages in topological order:" in lines
    assert lines.index("-- ~~  - zeta") < lines.index("-- ~~  - alpha")
    assert "--   needs no building: 1 messages" in lines
    assert "--   program drive (src/drive.cpp; src/alpha/CMakeLists.txt:32): C++, not built" in lines
    assert "--   library wheel_plugin (src/wheel.cc; src/alpha/CMakeLists.txt:33): C++, not built" in lines
    assert "2 C++ targets are not built; all else runs as it is" in printed.err
    assert (workspace / "devel/.catkin").read_text() == str(workspace / "src")
    assert (workspace / "src/CMakeLists.txt").exists()
    assert (workspace / ".catkin_workspace").exists()
    assert _make() == 0, "a second time it is the same"


@pytest.mark.parametrize(
    ("needed", "known", "said"),
    [
        (
            "no_such_arm",
            "catkin libno-such-arm-dev",
            "apt install catkin libno-such-arm-dev, and then /usr/bin/catkin_make compiles them",
        ),
        ("no_such_arm", "libroscpp-dev", "there is neither a C++ compiler nor catkin here, which ROS 1 brings"),
        ("zeta", "catkin", "apt install catkin, and then /usr/bin/catkin_make compiles them"),
    ],
    ids=["Debian has all", "Debian lacks it", "the workspace has it"],
)
def test_debian_s_packages_that_a_build_needs_are_named(
    workspace: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
    needed: str,
    known: str,
    said: str,
) -> None:
    cmake = workspace / "src/alpha/CMakeLists.txt"
    cmake.write_text(f"find_package({needed} REQUIRED)\n{cmake.read_text()}")
    programs = workspace / "programs"
    programs.mkdir()
    (programs / "apt-cache").write_text(f'#!/bin/sh\n[ "$1" = pkgnames ] && printf "%s\\n" {known}\n')
    (programs / "apt-cache").chmod(0o755)
    monkeypatch.setenv("PATH", str(programs))

    assert _make() == 0

    assert capsys.readouterr().err == f"-- 2 C++ targets are not built; all else runs as it is; {said}\n"


@pytest.mark.slow
@pytest.mark.real_ros
def test_a_node_that_debian_s_catkin_compiled_runs_in_a_launch(tmp_path: Path) -> None:
    """First it is named with its source, as the launch goes on without it."""
    if not _ORIGINAL.exists():
        pytest.skip("Debian's catkin is not installed (make system)")
    package = tmp_path / "ws/src/drive"
    list(create_package(package.parent, NewPackage(name="drive", dependencies=("roscpp",))))
    with (package / "CMakeLists.txt").open("a") as file:
        file.write("add_executable(drive src/drive.cpp)\ntarget_link_libraries(drive ${catkin_LIBRARIES})\n")
    (package / "src").mkdir(exist_ok=True)
    (package / "src/drive.cpp").write_text(_DRIVE)
    launch = tmp_path / "drive.launch"
    launch.write_text(
        '<launch><node pkg="drive" type="drive" name="left" ns="r1" output="screen" required="true">'
        '<param name="speed" value="3"/></node></launch>'
    )
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        uri = f"http://127.0.0.1:{probe.getsockname()[1]}"
    env = {"PATH": "/usr/bin:/bin", "HOME": str(tmp_path), "ROS_PACKAGE_PATH": str(package.parent)}

    def run(*words: str | Path) -> str:
        there = {**env, "ROS_MASTER_URI": uri}
        done = subprocess.run(words, cwd=tmp_path / "ws", env=there, capture_output=True, text=True, check=False)
        return done.stdout + done.stderr

    command = (sys.executable, "-m", "trundle", "launch", launch, "--headless")
    assert f"C++ not compiled yet: {package}/CMakeLists.txt:" in run(*command)
    run(_ORIGINAL)
    said = run(*command)
    assert f"process  /r1/left  {tmp_path}/ws/devel/lib/drive/drive" in said
    assert "/r1/left drives at 3" in said


@pytest.mark.parametrize("shell", ["sh", "bash"])
def test_sourcing_it_makes_the_packages_found(workspace: Path, shell: str) -> None:
    assert _make() == 0
    name = "setup.bash" if shell == "bash" else "setup.sh"

    printed = _sourced(shell, [workspace / "devel" / name])

    assert printed["CMAKE_PREFIX_PATH"] == str(workspace / "devel")
    assert printed["ROS_PACKAGE_PATH"] == str(workspace / "src")
    assert printed["LD_LIBRARY_PATH"] == str(workspace / "devel/lib")
    assert printed["PATH"] == "/usr/bin:/bin"


def test_another_workspace_takes_its_place_or_extends_it(workspace: Path, tmp_path: Path) -> None:
    other = tmp_path / "other"
    list(create_package(other / "src", NewPackage(name="gamma")))
    assert _make() == 0
    assert _make("-C", str(other)) == 0
    first, second = workspace / "devel/setup.bash", other / "devel/setup.bash"

    assert _sourced("bash", [first, second])["ROS_PACKAGE_PATH"] == str(other / "src")
    both = f"{other / 'src'}:{workspace / 'src'}"
    assert _sourced("bash", [first, Path(f"{second} --extend")])["ROS_PACKAGE_PATH"] == both


def test_a_workspace_made_on_another_includes_it(
    workspace: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert _make() == 0
    monkeypatch.setenv("CMAKE_PREFIX_PATH", str(workspace / "devel"))
    other = tmp_path / "other"
    list(create_package(other / "src", NewPackage(name="gamma")))
    assert _make("-C", str(other)) == 0

    assert _sourced("bash", [other / "devel/setup.bash"])["ROS_PACKAGE_PATH"] == f"{other / 'src'}:{workspace / 'src'}"
    local = _sourced("bash", [other / "devel/local_setup.bash"])
    assert local["ROS_PACKAGE_PATH"] == str(other / "src")


def test_env_sh_runs_a_command_there(workspace: Path) -> None:
    assert _make() == 0

    done = subprocess.run(
        [workspace / "devel/env.sh", "sh", "-c", "echo $ROS_PACKAGE_PATH"], capture_output=True, text=True, check=True
    )

    assert done.stdout == f"{workspace / 'src'}\n"


@pytest.mark.parametrize(
    ("prepare", "arguments", "said"),
    [
        ("", ["-C", "nowhere"], "The specified base path .*nowhere.* does not exist"),
        ("package.xml", [], "contains a package but"),
        ("CMakeLists.txt", [], "contains a CMakeLists.txt but"),
        ("", ["--source", "sources"], "The specified source space .*sources.* does not exist"),
        ("", ["--pkg", "delta"], 'Packages "delta" not found in the workspace'),
        ("devel/.built_by", [], "was previously built by 'catkin build'"),
    ],
)
def test_what_is_wrong_is_said_in_the_originals_words(
    workspace: Path, prepare: str, arguments: list[str], said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    if prepare:
        (workspace / prepare).parent.mkdir(exist_ok=True)
        (workspace / prepare).write_text("catkin build")

    assert _make(*arguments) == 1

    assert re.search(said, capsys.readouterr().err)


@pytest.mark.slow
@pytest.mark.real_ros
def test_the_originals_devel_space_gives_the_same_environment(workspace: Path, tmp_path: Path) -> None:
    if not _ORIGINAL.exists():
        pytest.skip("Debian's catkin is not installed (make system)")
    theirs = tmp_path / "theirs"
    list(create_package(theirs / "src", NewPackage(name="zeta")))
    (workspace / "src/alpha/CATKIN_IGNORE").touch()
    env = {"PATH": "/usr/bin:/bin", "HOME": str(tmp_path), "PWD": str(theirs)}
    subprocess.run([_ORIGINAL], cwd=theirs, env=env, check=True, capture_output=True, timeout=300)
    assert _make() == 0

    original = _sourced("bash", [theirs / "devel/setup.bash"])
    ours = _sourced("bash", [workspace / "devel/setup.bash"])

    for variable in ("CMAKE_PREFIX_PATH", "LD_LIBRARY_PATH", "PATH"):
        assert ours[variable] == original[variable].replace(str(theirs), str(workspace)), variable
    made = {path.name for path in (theirs / "devel").iterdir()}
    assert made - {path.name for path in (workspace / "devel").iterdir()} <= {"_setup_util.py", "cmake.lock", "share"}
    kept = (theirs / "devel/setup.sh").read_text()
    assert _make("-C", str(theirs)) == 0
    assert (theirs / "devel/setup.sh").read_text() == kept, "what catkin itself made is kept"


def _sourced(shell: str, files: list[Path]) -> dict[str, str]:
    lines = [*(f". {file}" for file in files), "env"]
    env = {"PATH": "/usr/bin:/bin", "HOME": os.environ.get("HOME", "/")}
    done = subprocess.run([shell, "-ec", "\n".join(lines)], env=env, capture_output=True, text=True, check=True)
    assert done.stderr == ""
    return dict(line.split("=", 1) for line in done.stdout.splitlines() if "=" in line)
