"""catkin_make without a compiler: the devel space, its environment in a shell, and the report of C++ targets.

tests/ros/sdk has it with a compiler.
"""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest
from tests.graphs import free_port

from trundle.app.cli import main
from trundle.ros.catkin import NewPackage, create_package, open_workspace

_DEBIANS_TOOL = Path("/usr/bin/catkin_make")
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
    """A workspace with a Python package and a C++ package that depends on it."""
    for variable in (*_VARIABLES[:1], "ROS_PACKAGE_PATH", "TRUNDLE_SHELL"):
        monkeypatch.delenv(variable, raising=False)
    base = tmp_path / "ws"
    for name, dependencies in (("alpha", ("zeta", "roscpp")), ("zeta", ("rospy",))):
        list(create_package(base / "src", NewPackage(name=name, dependencies=dependencies)))
    with (base / "src/alpha/CMakeLists.txt").open("a") as file:
        file.write("add_executable(drive src/drive.cpp)\nadd_library(wheel_plugin SHARED src/wheel.cc)\n")
    (base / "src/zeta/msg").mkdir()
    (base / "src/zeta/msg/Speed.msg").write_text("float64 x\n")
    monkeypatch.setenv("PWD", str(base))
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("CXX", raising=False)
    monkeypatch.chdir(base)
    return base


def _make(*arguments: str) -> int:
    return main(["--as", "catkin_make", *arguments])


def test_a_workspace_gets_its_devel_space(workspace: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert _make() == 0

    output = capsys.readouterr()
    lines = output.out.splitlines()
    spaces = ("Source src", "Build build", "Devel devel", "Install install")
    lines_of_spaces = (f"{name} space: {workspace / folder}" for name, folder in map(str.split, spaces))
    assert lines[:5] == [f"Base path: {workspace}", *lines_of_spaces]
    assert "-- ~~  traversing 2 packages in topological order:" in lines
    assert lines.index("-- ~~  - zeta") < lines.index("-- ~~  - alpha")
    assert "--   needs no building: 1 messages" in lines
    assert "--   program drive (src/drive.cpp; src/alpha/CMakeLists.txt:32): C++, not built" in lines
    assert "--   library wheel_plugin (src/wheel.cc; src/alpha/CMakeLists.txt:33): C++, not built" in lines
    assert "2 C++ targets are not built; all else runs as it is; there is no C++ compiler; " in output.err
    assert (workspace / "devel/.catkin").read_text() == str(workspace / "src")
    assert (workspace / "src/CMakeLists.txt").exists()
    assert (workspace / ".catkin_workspace").exists()
    assert _make() == 0, "a second run succeeds, too"


def test_packages_are_selected_alone_or_with_their_dependencies(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert _make("--pkg", "alpha") == 0
    assert "-- ~~  traversing 1 packages in topological order:\n-- ~~  - alpha\n" in capsys.readouterr().out
    assert _make("--only-pkg-with-deps", "alpha") == 0
    assert "-- ~~  traversing 2 packages in topological order:\n-- ~~  - zeta\n" in capsys.readouterr().out


def test_catkin_build_lists_builds_and_cleans_from_a_folder_below(
    workspace: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("PWD", str(workspace / "src/alpha"))
    monkeypatch.chdir(workspace / "src/alpha")

    assert main(["--as", "catkin", "list"]) == 0
    assert capsys.readouterr().out == "- alpha\n- zeta\n"
    assert main(["--as", "catkin", "build", "zeta"]) == 0
    assert (workspace / "devel/setup.bash").exists()
    assert "alpha" not in capsys.readouterr().out
    assert main(["--as", "catkin", "clean"]) == 1
    assert "say so with catkin clean -y" in capsys.readouterr().err
    assert main(["--as", "catkin", "clean", "-y"]) == 0
    assert not (workspace / "devel").exists()
    assert (workspace / "src/zeta/package.xml").exists()


def test_a_sourced_ros_builds_by_its_own_tool(
    workspace: Path,
) -> None:
    """Its catkin_make, and not ours, runs with the same words."""
    ros = workspace / "ros"
    config = ros / "share/roscpp/cmake/roscppConfig.cmake"
    tool = ros / "bin/catkin_make"
    for path in (config, tool):
        path.parent.mkdir(parents=True)
        path.write_text('#!/bin/sh\necho "the real one: $*"\n')
    tool.chmod(0o755)
    environment = {**os.environ, "CMAKE_PREFIX_PATH": str(ros), "PATH": f"{tool.parent}:/usr/bin:/bin"}

    done = subprocess.run(
        [sys.executable, "-m", "trundle", "--as", "catkin_make", "--pkg", "alpha"],
        cwd=workspace,
        env=environment,
        capture_output=True,
        text=True,
        check=True,
    )

    assert done.stdout == f"-- a ROS is sourced: {tool} builds\nthe real one: --pkg alpha\n"
    assert not (workspace / "devel").exists()


@pytest.mark.slow
@pytest.mark.real_ros
def test_a_node_compiled_by_debians_catkin_runs_in_a_launch(tmp_path: Path) -> None:
    """Before it is compiled, the launch reports its source and continues without it."""
    if not _DEBIANS_TOOL.exists():
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
    uri = f"http://127.0.0.1:{free_port()}"
    env = {"PATH": "/usr/bin:/bin", "HOME": str(tmp_path), "ROS_PACKAGE_PATH": str(package.parent)}

    def run(*words: str | Path) -> str:
        environment = {**env, "ROS_MASTER_URI": uri}
        done = subprocess.run(words, cwd=tmp_path / "ws", env=environment, capture_output=True, text=True, check=False)
        return done.stdout + done.stderr

    command = (sys.executable, "-m", "trundle", "launch", launch, "--headless")
    assert f"C++ not compiled yet: {package}/CMakeLists.txt:" in run(*command)
    run(_DEBIANS_TOOL)
    output = run(*command)
    assert f"process  /r1/left  {tmp_path}/ws/devel/lib/drive/drive" in output
    assert "/r1/left drives at 3" in output


@pytest.mark.parametrize("shell", ["sh", "bash"])
def test_sourcing_the_setup_file_sets_the_package_path(workspace: Path, shell: str) -> None:
    assert _make() == 0
    name = "setup.bash" if shell == "bash" else "setup.sh"

    output = _sourced(shell, [workspace / "devel" / name])

    assert output["CMAKE_PREFIX_PATH"] == str(workspace / "devel")
    assert output["ROS_PACKAGE_PATH"] == str(workspace / "src")
    assert output["LD_LIBRARY_PATH"] == str(workspace / "devel/lib")
    assert output["PATH"] == "/usr/bin:/bin"


def test_another_workspace_replaces_or_extends_the_first(workspace: Path, tmp_path: Path) -> None:
    other = tmp_path / "other"
    list(create_package(other / "src", NewPackage(name="gamma")))
    assert _make() == 0
    assert _make("-C", str(other)) == 0
    first, second = workspace / "devel/setup.bash", other / "devel/setup.bash"

    assert _sourced("bash", [first, second])["ROS_PACKAGE_PATH"] == str(other / "src")
    both = f"{other / 'src'}:{workspace / 'src'}"
    assert _sourced("bash", [first, Path(f"{second} --extend")])["ROS_PACKAGE_PATH"] == both


def test_a_workspace_built_on_another_includes_it(
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


def test_env_sh_runs_a_command_in_the_environment(workspace: Path) -> None:
    assert _make() == 0

    done = subprocess.run(
        [workspace / "devel/env.sh", "sh", "-c", "echo $ROS_PACKAGE_PATH"],
        env={"PATH": "/usr/bin:/bin"},
        capture_output=True,
        text=True,
        check=True,
    )

    assert done.stdout == f"{workspace / 'src'}\n"


@pytest.mark.parametrize(
    ("prepare", "arguments", "message"),
    [
        ("", ["-C", "nowhere"], "The specified base path .*nowhere.* does not exist"),
        ("package.xml", [], "contains a package but"),
        ("CMakeLists.txt", [], "contains a CMakeLists.txt but"),
        ("", ["--source", "sources"], "The specified source space .*sources.* does not exist"),
        ("", ["--pkg", "delta"], 'Packages "delta" not found in the workspace'),
        ("devel/.built_by", [], "was previously built by 'catkin build'"),
    ],
)
def test_errors_have_catkin_makes_texts(
    workspace: Path, prepare: str, arguments: list[str], message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    if prepare:
        (workspace / prepare).parent.mkdir(exist_ok=True)
        (workspace / prepare).write_text("catkin build")

    assert _make(*arguments) == 1

    assert re.search(message, capsys.readouterr().err)


@pytest.mark.slow
@pytest.mark.real_ros
def test_the_devel_space_of_debians_catkin_gives_the_same_environment(workspace: Path, tmp_path: Path) -> None:
    if not _DEBIANS_TOOL.exists():
        pytest.skip("Debian's catkin is not installed (make system)")
    other = tmp_path / "other"
    list(create_package(other / "src", NewPackage(name="zeta")))
    (workspace / "src/alpha/CATKIN_IGNORE").touch()
    env = {"PATH": "/usr/bin:/bin", "HOME": str(tmp_path), "PWD": str(other)}
    subprocess.run([_DEBIANS_TOOL], cwd=other, env=env, check=True, capture_output=True, timeout=300)
    assert _make() == 0

    debians = _sourced("bash", [other / "devel/setup.bash"])
    ours = _sourced("bash", [workspace / "devel/setup.bash"])

    for variable in ("CMAKE_PREFIX_PATH", "LD_LIBRARY_PATH", "PATH"):
        assert ours[variable] == debians[variable].replace(str(other), str(workspace)), variable
    names = {path.name for path in (other / "devel").iterdir()}
    assert names - {path.name for path in (workspace / "devel").iterdir()} <= {"_setup_util.py", "cmake.lock", "share"}
    text = (other / "devel/setup.sh").read_text()
    assert _make("-C", str(other)) == 0
    assert (other / "devel/setup.sh").read_text() == text, "files of catkin itself are kept"


def _sourced(shell: str, files: list[Path]) -> dict[str, str]:
    lines = [*(f". {file}" for file in files), "env"]
    env = {"PATH": "/usr/bin:/bin", "HOME": os.environ.get("HOME", "/")}
    done = subprocess.run([shell, "-ec", "\n".join(lines)], env=env, capture_output=True, text=True, check=True)
    assert done.stderr == ""
    return dict(line.split("=", 1) for line in done.stdout.splitlines() if "=" in line)


def test_a_package_of_rosbuild_is_not_built(workspace: Path) -> None:
    old = workspace / "src/old"
    old.mkdir()
    (old / "manifest.xml").write_text("<package><description brief='old'/></package>")

    assert "old" not in open_workspace(workspace).packages()
