"""Packages fetched by the commands in tutorials, from a git server on this machine."""

import os
import pty
import shutil
import subprocess
import sys
from collections.abc import Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from threading import Thread

import pytest
from tests.git_server import GitServer, git_server, manifest
from tests.graphs import free_port

from trundle.app.cli.main import main
from trundle.robots.packages import LENIENT

LAUNCH = """<launch>
  <include file="$(find arm_bringup)/arm.launch"/>
  <param name="robot_description" command="xacro $(find my_robot)/my.urdf.xacro"/>
</launch>"""
XACRO = """<robot name="my" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:include filename="$(find hand)/hand.xacro"/>
</robot>"""
USB_CAM = """<launch><node pkg="usb_cam" type="usb_cam_node" name="usb_cam">
  <param name="video_device" value="/dev/video9"/>
</node></launch>"""
HAND = '<robot xmlns:xacro="http://ros.org/wiki/xacro"><link name="palm"/></robot>'


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[GitServer]:
    with git_server(tmp_path_factory.mktemp("served")) as server:
        arm = {"arm_bringup/package.xml": manifest("arm_bringup", "arm_msgs"), "arm_bringup/arm.launch": "<launch/>"}
        server.add("me/arm", {"noetic-devel": arm})
        server.add("me/arm_msgs", {"main": {"package.xml": manifest("arm_msgs")}})
        server.add("me/hand", {"main": {"package.xml": manifest("hand"), "hand.xacro": HAND}})
        camera = {"package.xml": manifest("usb_cam", "image_view"), "launch/usb_cam-test.launch": USB_CAM}
        server.add("me/usb_cam", {"main": camera})
        yield server


@pytest.fixture
def index(server: GitServer, tmp_path: Path) -> Path:
    rows = {
        "arm_bringup": ("arm", "noetic-devel"),
        **{name: (name, "main") for name in ("arm_msgs", "hand", "usb_cam", "image_view")},
    }
    lines = [
        f"  {package}: {{source: {{type: git, url: '{server.address}/me/{name}', version: {branch}}}}}"
        for package, (name, branch) in rows.items()
    ]
    file = tmp_path / "index.yaml"
    file.write_text("\n".join(["repositories:", *lines, ""]))
    return file


@pytest.fixture
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A workspace with a package that needs three others, and a data folder next to it."""
    package = tmp_path / "ws/src/my_robot"
    package.mkdir(parents=True)
    (package / "package.xml").write_text(manifest("my_robot", "arm_bringup", "hand", "rospy", "python3-serial"))
    (package / "my.launch").write_text(LAUNCH)
    (package / "my.urdf.xacro").write_text(XACRO)
    monkeypatch.setenv("XDG_DATA_HOME", str(tmp_path / "data"))
    monkeypatch.setenv("ROS_PACKAGE_PATH", "")
    monkeypatch.chdir(tmp_path / "ws")
    return tmp_path / "ws"


def fetched(tmp_path: Path) -> list[str]:
    return sorted(str(path.relative_to(tmp_path / "data/trundle/packages")) for path in tmp_path.glob("data/*/*/*/*"))


def test_rosdep_fetches_the_dependencies_of_a_workspace(
    workspace: Path, index: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["rosdep", "install", "--from-paths", "src", "--ignore-src", "-r", "-y", "--rosdistro", "noetic", "--index"]

    assert main(["--as", *words, str(index)]) == 0

    out = capsys.readouterr().out
    assert fetched(tmp_path) == ["me/arm", "me/arm_msgs", "me/hand"]
    assert "part of Trundle: catkin rospy" in out
    assert "/me/arm (noetic-devel): arm_bringup\n" in out
    assert out.splitlines()[-1] == f"Python libraries: {sys.executable} -m pip install pyserial"
    assert sorted(os.listdir(workspace / "src")) == ["my_robot"], "the workspace is unchanged"


def test_a_hostile_repository_or_index_cannot_run_code_or_read_files(
    workspace: Path, server: GitServer, index: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """`rosdep install` and `pack get`: a package's links, submodules and setup files, and rows of the index."""
    (tmp_path / "secret").write_text("mine")
    ran = tmp_path / "ran"
    evil = {
        "package.xml": manifest("evil", "arm_msgs"),
        "setup.py": f"open({str(ran)!r}, 'w')\n",
        ".gitmodules": f'[submodule "a"]\n\tpath = a\n\turl = file://{tmp_path}\n\tupdate = !touch {ran}\n',
    }
    server.add("you/evil", {"main": evil}, {"secret": str(tmp_path / "secret")})
    rows = {
        "evil": (f"{server.address}/you/evil", "main"),
        "local": (f"file://{server.folder}/me/arm", "noetic-devel"),
        "option": (f"{server.address}/me/arm", "--upload-pack=touch ran"),
        "program": (f"ext::sh -c 'touch {ran}'", "main"),
    }
    with index.open("a") as file:
        for name, (url, version) in rows.items():
            file.write(f'  {name}: {{source: {{type: git, url: "{url}", version: "{version}"}}}}\n')
    (workspace / "src/my_robot/package.xml").write_text(manifest("my_robot", "arm_bringup", "hand", *rows))
    data = tmp_path / "data/trundle/packages"

    for words in (["--as", "rosdep", "install", "--from-paths", "src", "-y"], ["pack", "get", "-y", *rows]):
        assert main([*words, "--index", str(index)]) == 0
        assert "system packages, if needed: local option program\n" in capsys.readouterr().out
        assert not ran.exists()
        assert sorted(os.listdir(data / "you/evil")) == [".git", ".gitmodules", "package.xml", "setup.py"]
        assert (data / "me/arm_msgs/package.xml").is_file()
        shutil.rmtree(data)


@pytest.mark.usefixtures("workspace")
def test_nothing_is_fetched_without_confirmation(
    index: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["pack", "get", "hand", "--index", str(index)]) == 1
    assert capsys.readouterr().err == "trundle pack: error: fetching needs a confirmation; -y gives it\n"
    assert fetched(tmp_path) == []


@pytest.fixture
def web(index: Path, tmp_path: Path) -> Iterator[str]:
    """Address of a web server with a published index, and an index that refers to a local file."""
    folder = tmp_path / "web"
    (folder / "noetic").mkdir(parents=True)
    shutil.copy(index, folder / "noetic/distribution.yaml")
    for name, file in (("index-v4", "noetic/distribution.yaml"), ("hostile", f"file://{index}")):
        (folder / f"{name}.yaml").write_text(f"distributions: {{noetic: {{distribution: ['{file}']}}}}\n")
    handler = partial(SimpleHTTPRequestHandler, directory=str(folder))
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as http:
        thread = Thread(target=http.serve_forever)
        thread.start()
        yield f"http://127.0.0.1:{http.server_port}"
        http.shutdown()
        thread.join()


@pytest.mark.usefixtures("workspace")
def test_an_index_is_read_from_the_web(web: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """An index from the web cannot refer to local files."""
    assert main(["pack", "get", "-y", "arm_bringup", "--index", f"{web}/index-v4.yaml"]) == 0
    assert fetched(tmp_path) == ["me/arm", "me/arm_msgs"]
    capsys.readouterr()

    for name, message in (("hostile", "an index is fetched from http:// or https://"), ("gone", "not fetched: ")):
        assert main(["pack", "get", "-y", "hand", "--index", f"{web}/{name}.yaml"]) == 1
        assert message in capsys.readouterr().err
    assert fetched(tmp_path) == ["me/arm", "me/arm_msgs"]


@pytest.mark.usefixtures("workspace")
def test_all_packages_of_a_launch_file_are_fetched(
    index: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Also packages that only a xacro file names, which is read after the includes were fetched."""
    assert main(["pack", "get", "-y", "--index", str(index), "--missing", "my_robot", "my.launch"]) == 0
    assert fetched(tmp_path) == ["me/arm", "me/arm_msgs", "me/hand"]
    assert capsys.readouterr().out.splitlines()[-1] == "all available packages are fetched"

    assert main(["launch", "my_robot", "my.launch", "--dump-params"]) == 0
    assert "palm" in capsys.readouterr().out


@pytest.mark.usefixtures("workspace")
def test_missing_packages_are_found_with_the_variables_of_env_hooks(
    index: Path, workspace: Path, tmp_path: Path
) -> None:
    package = workspace / "src/my_robot"
    (package / "env-hooks").mkdir()
    (package / "env-hooks/my.sh").write_text("export MY_LAUNCH=arm.launch\n")
    (package / "my.launch").write_text('<launch><include file="$(find arm_bringup)/$(env MY_LAUNCH)"/></launch>')
    assert main(["pack", "get", "-y", "--index", str(index), "--missing", "my_robot", "my.launch"]) == 0
    assert fetched(tmp_path) == ["me/arm", "me/arm_msgs"]


def test_a_launch_offers_to_fetch_on_a_terminal(
    workspace: Path, server: GitServer, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One prompt, also for packages that only the robot's file names."""
    terminal, stdin = pty.openpty()
    code = (
        "import sys; from trundle.robots import repositories; from trundle.robots.repositories import Entry, Index\n"
        f"index = Index([Entry('{server.address}/me/' + r, {{}}, (p,)) for r, p in "
        "(('arm', 'arm_bringup'), ('arm_msgs', 'arm_msgs'), ('hand', 'hand'))])\n"
        "repositories.shipped_index = lambda: index\n"
        "from trundle.app.cli.main import main; sys.exit(main(['launch', 'my_robot', 'my.launch', '--dump-params']))"
    )
    os.write(terminal, b"\n")
    words = [sys.executable, "-c", code]
    process = subprocess.run(words, stdin=stdin, stdout=subprocess.PIPE, stderr=stdin, cwd=workspace, check=False)
    os.close(stdin)
    output = os.read(terminal, 100_000).decode()
    os.close(terminal)

    assert output.count("fetch 2 repositories? [Y/n]") == output.count("[Y/n]") == 1
    assert process.returncode == 0, output
    assert "palm" in process.stdout.decode()
    assert fetched(tmp_path) == ["me/arm", "me/arm_msgs", "me/hand"]


@pytest.mark.usefixtures("workspace")
def test_a_missing_package_is_an_error_with_a_remedy(capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    (tmp_path / "a.launch").write_text('<launch><include file="$(find turtlebot3_gazebo)/a.launch"/></launch>')

    assert main(["launch", str(tmp_path / "a.launch")]) == 1

    last = capsys.readouterr().err.splitlines()[-1]
    assert last == "trundle pack get turtlebot3_gazebo fetches them; --lenient leaves out what needs them"


@pytest.mark.usefixtures("workspace")
def test_all_missing_packages_are_reported_together(capsys: pytest.CaptureFixture[str], workspace: Path) -> None:
    """Packages of launch files, nodes, the robot's file and its meshes, with line and address."""
    package = workspace / "src/my_robot"
    (package / "my.launch").write_text(
        """<launch>
  <include file="$(find turtlebot3_gazebo)/a.launch"/>
  <node pkg="rosapi" type="rosapi_node" name="rosapi"/>
  <node pkg="tf2_web_republisher" type="tf2_web_republisher" name="tf2_web"/>
  <node pkg="image_proc" type="image_proc" name="proc"/>
  <param name="robot_description" command="xacro $(find my_robot)/my.urdf.xacro"/>
</launch>"""
    )
    (package / "my.urdf.xacro").write_text(
        """<robot name="my" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:include filename="$(find ur_description)/ur.xacro"/>
  <xacro:include filename="$(find no_such_hand)/hand.xacro"/>
  <link name="a"><visual><geometry><mesh filename="package://pr2_description/a.dae"/></geometry></visual></link>
</robot>"""
    )
    names = {
        "turtlebot3_gazebo": "my.launch:2",
        "image_proc": "my.launch:5",
        "ur_description": "my.urdf.xacro:2",
        "no_such_hand": "my.urdf.xacro:3",
        "pr2_description": "my.launch:6",
    }
    published = {"turtlebot3_gazebo", "image_proc", "ur_description", "pr2_description"}

    assert main(["launch", "my_robot", "my.launch"]) == 1

    *_, last = lines = capsys.readouterr().err.splitlines()
    errors = {line.split("'")[1]: line for line in lines if ": error: no package" in line}
    assert set(errors) == set(names)
    for name, location in names.items():
        assert errors[name].startswith(f"{package}/{location}: error: no package '{name}'")
        assert ("; it is published at https://github.com/" in errors[name]) == (name in published)
    assert set(last.partition(" fetches them")[0].split()[3:]) == published


def test_repository_lists_are_named_if_no_index_has_a_package(
    workspace: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """For example a repository's dependencies.rosinstall, with packages that were never released."""
    lists = workspace / "src/my_robot/repos/my_robot.repos"
    lists.parent.mkdir()
    lists.write_text("repositories: {}\n")
    launch = workspace / "a.launch"
    launch.write_text('<launch><include file="$(find no_such_control)/a.launch"/></launch>')

    assert main(["launch", str(launch)]) == 1

    message = f"no index has no_such_control; lists of repositories here: {lists}: vcs import in trundle shell fetches"
    assert f"{message} what one names\n" in capsys.readouterr().err


def test_files_of_a_package_with_stand_in_nodes_are_fetched_if_needed(
    workspace: Path, index: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A package that only depends on it needs no files."""
    launch = workspace / "camera.launch"
    launch.write_text('<launch><include file="$(find usb_cam)/launch/usb_cam-test.launch"/></launch>')
    assert main(["launch", str(launch)]) == 1
    errors = capsys.readouterr().err
    assert f"{launch}:1: error: no package 'usb_cam'; " in errors
    assert errors.splitlines()[-1].startswith("trundle pack get usb_cam fetches them; ")
    (workspace / "src/my_robot/package.xml").write_text(manifest("my_robot", "usb_cam"))
    assert main(["--as", "rosdep", "install", "my_robot", "-y", "--index", str(index)]) == 0
    assert fetched(tmp_path) == []

    assert main(["pack", "get", "-y", "--index", str(index), "--missing", str(launch)]) == 0

    assert fetched(tmp_path) == ["me/usb_cam"], "image_view has a stand-in, and none of its files is needed"
    capsys.readouterr()
    assert main(["launch", str(launch), "--dump-params"]) == 0
    assert "/usb_cam/video_device: /dev/video9" in capsys.readouterr().out


@pytest.mark.usefixtures("workspace")
def test_nodes_of_a_skipped_machine_are_skipped(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv(LENIENT, "0")  # restored after the test
    launch = tmp_path / "a.launch"
    launch.write_text(
        """<launch>
  <machine name="far" address="localhost" env-loader="$(find no_such_robot)/env.sh"/>
  <node machine="far" pkg="topic_tools" type="relay" name="there" args="a b"/>
  <node pkg="topic_tools" type="relay" name="here" args="c d"/>
</launch>"""
    )
    assert (
        main(["launch", str(launch), "--headless", "--port", str(free_port()), "--duration", "0.1", "--lenient"]) == 0
    )
    out, err = capsys.readouterr()
    assert f"{launch}:2: warning: no package 'no_such_robot'; <machine> far is left out" in err
    assert f"{launch}:3: warning: node 'there': no machine 'far', so it cannot be launched" in err
    assert "stand-in  /here" in out
    assert "/there" not in out


def test_apt_fetches_ros_packages(index: Path, workspace: Path, tmp_path: Path) -> None:
    """Names have - for _; the other arguments go to the system's apt, also after `sudo`."""
    programs = tmp_path / "programs"
    programs.mkdir()
    (programs / "apt-get").write_text(f'#!/bin/sh\necho "$@" >> {tmp_path}/apt.log\n')
    (programs / "apt-get").chmod(0o755)
    code = (
        "import sys; from trundle.robots import repositories; from trundle.robots.repositories import read_index\n"
        f"index = read_index({str(index)!r}, 'noetic'); repositories.shipped_index = lambda: index\n"
        "from trundle.app.cli.main import main; sys.exit(main(sys.argv[1:]))"
    )

    def apt(*words: str) -> int:
        environment = {**os.environ, "PATH": f"{programs}:{os.environ['PATH']}"}
        line = [sys.executable, "-c", code, "--as", *words]
        return subprocess.run(line, cwd=workspace, env=environment, check=False).returncode

    assert apt("apt-get", "install", "-y", "ros-noetic-arm-bringup", "tmux") == 0
    assert fetched(tmp_path) == ["me/arm", "me/arm_msgs"]
    assert (tmp_path / "apt.log").read_text() == "install -y tmux\n"
    assert apt("apt-get", "update") == 0
    assert (tmp_path / "apt.log").read_text() == "install -y tmux\nupdate\n"
    assert apt("sudo", "apt-get", "install", "-y", "ros-kinetic-hand") == 0
    assert fetched(tmp_path) == ["me/arm", "me/arm_msgs", "me/hand"]


def test_lists_of_repositories_are_fetched_into_the_workspace(workspace: Path, server: GitServer) -> None:
    lists = workspace / "my.repos"
    lists.write_text(f"repositories: {{arm: {{type: git, url: '{server.address}/me/arm', version: noetic-devel}}}}\n")

    assert main(["--as", "vcs", "import", "src", "--input", str(lists)]) == 0
    assert (workspace / "src/arm/arm_bringup/arm.launch").is_file()

    assert main(["--as", "wstool", "init", "src"]) == 0
    assert main(["--as", "wstool", "set", "-t", "src", "grip/hand", "--git", f"{server.address}/me/hand"]) == 0
    assert main(["--as", "wstool", "update", "-t", "src"]) == 0
    assert (workspace / "src/grip/hand/hand.xacro").is_file()

    other = workspace / "other"
    assert main(["--as", "rosinstall", str(other), str(workspace / "src/.rosinstall")]) == 0
    assert (other / "grip/hand/package.xml").is_file()
