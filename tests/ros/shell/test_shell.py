"""`trundle shell` and `trundle activate`: commands first on PATH, nothing left afterwards."""

import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from tests.ros.shell.terminal import Terminal

from trundle.app.cli import main
from trundle.app.cli.originals import ORIGINALS

TIMEOUT_S = 100.0
COMMANDS = """
    gazebo gzserver gzclient gz roscore roslaunch rosrun rostopic rosnode rosparam rosservice rosmsg rossrv rosbag
    rospack roscd rosls rosversion rosclean roswtf rostest rviz rqt rqt_graph rqt_plot rqt_image_view rqt_console xacro
    check_urdf urdf_to_graphiz tf_echo view_frames tf_monitor catkin catkin_create_pkg catkin_init_workspace catkin_make
    rosdep rosinstall wstool vcs apt apt-get sudo xterm x-terminal-emulator
""".split()  # noqa: SIM905 - more readable


@pytest.fixture
def run(env: dict[str, str], tmp_path: Path, temporary: Path):
    """Run a program in the user's home folder."""

    def call(*words: str, **more: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            words, env={**env, **more}, cwd=tmp_path, capture_output=True, text=True, timeout=TIMEOUT_S, check=False
        )

    return call


@pytest.fixture
def shell(run):
    """Run a command with `trundle shell -c`."""
    return lambda command, **more: run(sys.executable, "-m", "trundle", "shell", "-c", command, **more)


@pytest.fixture
def temporary(tmp_path: Path, env: dict[str, str]) -> Path:
    """Folder of temporary files, which must be empty at the end."""
    folder = tmp_path / "temporary"
    folder.mkdir()
    env["TMPDIR"] = str(folder)
    return folder


def test_every_command_of_the_tutorials_exists() -> None:
    assert set(COMMANDS) == set(ORIGINALS)


def test_commands_are_first_on_path(shell, temporary: Path) -> None:
    done = shell(f"type -P {' '.join(COMMANDS)}")

    folders, names = zip(*(line.rsplit("/", 1) for line in done.stdout.splitlines()), strict=True)
    assert names == tuple(COMMANDS)
    assert {Path(folder).parent.parent for folder in folders} == {temporary}
    assert list(temporary.iterdir()) == [], "temporary files are removed"


@pytest.mark.parametrize("name", COMMANDS)
def test_each_command_has_help_under_its_name(name: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--as", name, "--help"]) == 0

    output = capsys.readouterr().out
    assert "usage: " in output
    assert f"  {name}" in output or ORIGINALS[name][1:], "the examples have its name"


def test_the_exit_code_is_that_of_the_command(shell) -> None:
    assert shell("exit 7").returncode == 7
    assert shell("kill -TERM $$").returncode == 128 + 15


def test_roscd_changes_the_folder(shell, tmp_path: Path) -> None:
    package = tmp_path / "ws/src/my_robot"
    (package / "launch").mkdir(parents=True)
    (package / "package.xml").write_text("<package><name>my_robot</name><version>1.2.3</version></package>")

    done = shell(
        "cd ws; catkin_make > /dev/null; source devel/setup.bash; roscd my_robot/launch; pwd; rosls my_robot;"
        "rosversion my_robot; roscd; pwd; roscd none; echo $?; roscd a b",
        SHELL="/bin/bash",
    )

    lines = done.stdout.splitlines()
    assert lines[:4] == [str(package / "launch"), "launch", "package.xml", "1.2.3"]
    assert lines[4:6] == [str(tmp_path / "ws/devel"), "1"]
    assert lines[6] == "usage: roscd package"
    assert "No such package/stack 'none'" in done.stderr


@pytest.mark.parametrize("shell_name", ["bash", "zsh", "sh", "fish"])
def test_tutorials_copy_files_of_packages_from_opt_ros(run, shell_name: str, tmp_path: Path) -> None:
    if shutil.which(shell_name) is None:
        pytest.skip(f"{shell_name} is not installed")
    share = "/opt/ros/indigo/share"
    copy = f"cp -r {share}/gazebo_ros/launch 'a b' copied; cp {share}/none_such/a.txt .; ls copied copied/launch"
    start = f"{sys.executable} -m trundle activate --shell fish | source" if shell_name == "fish" else ""
    start = start or f'eval "$({sys.executable} -m trundle activate)"'
    for name in ("copied", "a b"):
        (tmp_path / name).mkdir()

    done = run(shell_name, "-c", f"{start}; {copy}; trundle_deactivate; type cp")

    assert "empty_world.launch" in done.stdout
    assert "a b" in done.stdout
    errors = [line for line in done.stderr.splitlines() if line.startswith(("trundle: ", "rospack: "))]
    assert errors[0].startswith(f"trundle: {share}/gazebo_ros is ")
    assert errors[1].startswith("rospack: error: no package 'none_such'")
    assert "function" not in done.stdout.splitlines()[-1]


def test_the_users_own_python_imports_rospy_and_its_libraries(shell, tmp_path: Path) -> None:
    """A virtual environment without Trundle, of Trundle's Python version."""
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", "own"], cwd=tmp_path, check=True)

    done = shell("own/bin/python -c 'import rospy, numpy; print(rospy.Time(2), numpy.__name__)'")

    assert done.stdout == "2000000000 numpy\n", done.stderr


def test_scripts_that_open_terminals_run_without_a_display(shell, tmp_path: Path) -> None:
    """Like `home_service.sh` of courses, which opens one for each program."""
    (tmp_path / "home_service.sh").write_text(
        "#!/bin/sh\nxterm -hold -e \"export POSE='-x 1' && env | grep ^POSE\" &\nwait\n"
        "x-terminal-emulator -T title -e echo 'two  words'\nxterm\necho $?\n"
    )

    done = shell("sh home_service.sh", DISPLAY="", WAYLAND_DISPLAY="")

    assert done.stdout.splitlines() == ["POSE=-x 1", "two  words", "1"], done.stderr
    assert "xterm: no window can open here; running in this terminal: export POSE='-x 1' && " in done.stderr
    assert "xterm needs a display, and there is none here" in done.stderr


def test_the_real_xterm_runs_with_a_display(shell, tmp_path: Path) -> None:
    xterm = tmp_path / "real/xterm"
    xterm.parent.mkdir()
    xterm.write_text('#!/bin/sh\necho "window: $@"\n')
    xterm.chmod(0o755)

    done = shell(f"PATH=$TRUNDLE_SHELL/bin:{xterm.parent}:/usr/bin:/bin; xterm -e ls", DISPLAY=":9")

    assert done.stdout == "window: -e ls\n", done.stderr


@pytest.mark.parametrize("shell_name", ["bash", "zsh", "sh"])
def test_activate_adds_the_commands_and_deactivate_removes_them(run, shell_name: str, temporary: Path) -> None:
    if shutil.which(shell_name) is None:
        pytest.skip(f"{shell_name} is not installed")
    trundle = f"{sys.executable} -m trundle"
    script = f"""
        before="$PATH:$ROS_DISTRO:$PYTHONPATH"
        eval "$({trundle} activate)"
        command -v rostopic; echo "distro $ROS_DISTRO"
        trundle_deactivate
        [ "$before" = "$PATH:$ROS_DISTRO:$PYTHONPATH" ] && echo same
    """

    done = run(shell_name, "-c", script)

    first, *rest = done.stdout.splitlines()
    assert first.startswith(str(temporary)), done.stderr
    assert rest == ["distro noetic", "same"]
    assert list(temporary.iterdir()) == []


def test_programs_in_the_shell_import_rospy(shell) -> None:
    done = shell(
        f"{sys.executable} -c 'import rospy, std_msgs.msg; print(rospy.__name__, std_msgs.msg.String(\"hi\").data)'"
    )
    assert done.stdout == "rospy hi\n", done.stderr


def test_bash_removes_the_activation_files_when_it_ends(run, temporary: Path) -> None:
    done = run("bash", "-c", f'eval "$({sys.executable} -m trundle activate)"; rosversion -d')

    assert done.stdout == "noetic\n"
    assert list(temporary.iterdir()) == []


def test_activate_on_a_terminal_prints_its_usage(env: dict[str, str], tmp_path: Path, temporary: Path) -> None:
    with Terminal([sys.executable, "-m", "trundle", "activate"], env, tmp_path) as terminal:
        terminal.expect('eval "$(trundle activate)"')
        assert terminal.wait() == 0
    assert list(temporary.iterdir()) == []


@pytest.mark.parametrize("shell_name", ["bash", "zsh"])
def test_an_interactive_shell_reads_its_start_files_and_completes(
    env: dict[str, str], tmp_path: Path, temporary: Path, shell_name: str
) -> None:
    program = shutil.which(shell_name)
    if program is None:
        pytest.skip(f"{shell_name} is not installed")
    (tmp_path / f".{shell_name}rc").write_text("mine='my own'\nPS1='ready> '\n")
    env |= {"SHELL": program, "TERM": "dumb"}
    with Terminal([sys.executable, "-m", "trundle", "shell"], env, tmp_path) as terminal:
        terminal.expect("(trundle) ready> ")
        terminal.type('echo "[$mine]"')
        terminal.expect("[my own]")
        terminal.keys("rosversion --dis\t")
        terminal.expect("rosversion --distro")
        terminal.keys("\n")
        terminal.expect("noetic")
        terminal.keys("roscd rospy_tu\x15")
        terminal.keys("sleep 1000\n")
        terminal.expect("sleep 1000")
        terminal.expect_program("sleep")
        terminal.keys("\x03")
        terminal.expect("(trundle) ready> ")  # what is typed sooner may lose its first letters
        terminal.type("echo still $((40 + 2))")
        terminal.expect("still 42")
        terminal.type("exit 3")
        assert terminal.wait() == 3
    assert list(temporary.iterdir()) == []


def test_commands_are_completed(run, tmp_path: Path) -> None:
    """As a shell requests it: the typed line, with the ROS command's name."""
    answer = tmp_path / "answer"
    (tmp_path / "my_robot").mkdir()
    (tmp_path / "my_robot/package.xml").write_text("<package><name>my_robot</name></package>")
    for line, completion in (
        ("rostopic ec", "echo "),
        ("rosmsg show geometry_msgs/PointSt", "geometry_msgs/PointStamped "),
        ("rosrun turtlesim turtlesim_", "turtlesim_node "),
        ("gz sd", "sdf "),
        ("roscd my_ro", "my_robot "),
    ):
        variables = {"_ARGCOMPLETE": "1", "_ARGCOMPLETE_IFS": "\n", "_ARGCOMPLETE_STDOUT_FILENAME": str(answer)}
        name = line.partition(" ")[0]
        run(
            *(sys.executable, "-m", "trundle", "--as", name),
            **{**variables, "COMP_LINE": line, "COMP_POINT": str(len(line)), "ROS_PACKAGE_PATH": str(tmp_path)},
        )
        assert [word for word in answer.read_text().split("\n") if word == completion] == [completion], line
