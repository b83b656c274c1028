"""`trundle launch`: options, logs, respawn, required nodes."""

import os
import re
import signal
import socket
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
import yaml

from trundle.ros import Core, GraphLoop, open_bag

REAL_ROSLAUNCH = "/usr/bin/roslaunch"
_MANIFEST = """<package><name>p</name><version>1.0.0</version><description>d</description>
<maintainer email="a@b.c">m</maintainer><license>x</license></package>"""
_TALK = """#!/bin/sh
echo "hello $* in $(pwd) $GREETING"
case "$1" in [0-9]*) sleep "$1";; *) sleep 1000;; esac
case "$2" in [0-9]*) exit "$2";; esac
"""
_MAIN = """<launch>
  <arg name="who" default="bob" doc="whom to greet"/><arg name="need"/><arg name="fixed" value="3"/>
  <arg name="empty" default=""/>
  <param name="greeting" value="hi $(arg who)"/><param name="x" value="1.5"/><param name="t" value="true"/>
  <param name="long" value="a very long string that is cut in the summary because it is long"/>
  <rosparam>{a: {b: [1, 2, {c: d}], s: "x\\ny"}}</rosparam>
  <group ns="sub">
    <node pkg="p" type="talk" name="one" args="5 0 'x y'" output="screen">
      <remap from="a" to="b"/><env name="GREETING" value="1 2"/><param name="q" value="1"/>
    </node>
  </group>
  <node pkg="p" type="talk" name="two" launch-prefix="nice -n 5" args="0"/>
  <include file="$(dirname)/more.launch"/>
  <test test-name="tt" pkg="p" type="talk" name="tt"/>
</launch>"""
_BALL = """<sdf version="1.6"><model name="m"><link name="l"><collision name="c">
<geometry><sphere><radius>0.1</radius></sphere></geometry></collision></link></model></sdf>"""
_MORE = '<launch><node pkg="p" type="talk" name="five" args="0"/></launch>'

Launch = Callable[..., subprocess.CompletedProcess[str]]


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """A package with a program that talks and sleeps."""
    folder = tmp_path / "ws" / "p"
    for name, text in (("package.xml", _MANIFEST), ("main.launch", _MAIN), ("more.launch", _MORE), ("talk", _TALK)):
        folder.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    (folder / "talk").chmod(0o755)
    return folder


@pytest.fixture
def launch(trundle, env: dict[str, str], package: Path) -> Iterator[Launch]:
    """Run launches with a running master; they end with their last node."""

    def call(*words: str, **variables: str) -> subprocess.CompletedProcess[str]:
        return trundle("launch", *words, ROS_PACKAGE_PATH=str(package.parent), **variables)

    with GraphLoop() as loop:
        core = Core(loop=loop, port=int(env["ROS_MASTER_URI"].rpartition(":")[2]))
        loop.run(core.start())
        yield call
        loop.run(core.stop())


@pytest.mark.real_ros
@pytest.mark.parametrize(
    "option",
    ["--nodes", "--files", "--find-node=/five", "--args=/sub/one", "--args=/two", "--ros-args", "--dump-params"],
)
def test_output_of_options_equals_roslaunch(launch: Launch, package: Path, env: dict[str, str], option: str) -> None:
    if not Path(REAL_ROSLAUNCH).exists():
        pytest.skip("Debian's roslaunch is not installed (make system)")
    words = (option, str(package / "main.launch"), "need:=1")
    real_env = {**env, "PATH": "/usr/bin:/bin", "ROS_PACKAGE_PATH": str(package.parent)}
    real = subprocess.run([REAL_ROSLAUNCH, *words], env=real_env, capture_output=True, text=True, check=True)

    ours = launch(*words).stdout
    if option == "--files":  # roslaunch's order is arbitrary
        assert sorted(ours.splitlines()) == sorted(real.stdout.splitlines())
    else:
        assert ours == real.stdout


@pytest.mark.slow
@pytest.mark.real_ros
def test_the_summary_equals_roslaunch(trundle: Launch, package: Path, env: dict[str, str]) -> None:
    if not Path(REAL_ROSLAUNCH).exists():
        pytest.skip("Debian's roslaunch is not installed (make system)")

    def parts(output: str) -> list[str]:
        summary = output[output.index("SUMMARY") : output.index("process[") if "process[" in output else None]
        kept = [line for line in summary.splitlines() if not re.match(r" \* /ros(distro|version)|auto-starting", line)]
        return [line for line in kept if line]

    words = (str(package / "main.launch"), "need:=1")
    real_env = {**env, "PATH": "/usr/bin:/bin", "ROS_PACKAGE_PATH": str(package.parent)}
    with subprocess.Popen([REAL_ROSLAUNCH, *words], env=real_env, stdout=subprocess.PIPE, text=True) as real:
        assert real.stdout is not None
        lines: list[str] = []
        while "process[" not in (line := real.stdout.readline()):
            lines.append(line)
        real.terminate()
        real.communicate()
    ours = trundle("launch", *words, "--headless", "--duration", "0.1", ROS_PACKAGE_PATH=str(package.parent)).stdout

    assert parts(ours) == parts("".join(lines).replace("\033[1m", ""))


def test_arguments_are_listed_without_values(launch: Launch, package: Path) -> None:
    listed = launch("--ros-args", "p", "main.launch")

    assert listed.stdout.splitlines() == [
        "Required Arguments:",
        "  empty: undocumented",
        "  need: undocumented",
        "Optional Arguments:",
        '  who (default "bob"): whom to greet',
    ]


def test_output_goes_to_the_screen_or_to_a_log_file(launch: Launch, package: Path, tmp_path: Path) -> None:
    (package / "main.launch").write_text(
        '<launch><node pkg="p" type="talk" name="seen" args="0" output="screen" cwd="node"/>'
        '<node pkg="p" type="talk" name="kept" args="0" ns="deep"/></launch>'
    )
    done = launch("p", "main.launch", "--headless", ROS_LOG_DIR=str(tmp_path / "logs"))

    assert done.returncode == 0
    log = tmp_path / "logs/latest/deep-kept-2-stdout.log"
    assert log.read_text().startswith(f"hello 0 __name:=kept __log:={log.resolve().parent}/deep-kept-2.log in ")
    assert f"in {package}" in done.stdout
    assert "__name:=kept" not in done.stdout
    assert "[deep/kept-2] process has finished cleanly\nlog file: " in done.stdout
    assert re.search(r"process\[seen-1\]: started with pid \[\d+\]", done.stdout)
    (roslaunch_log,) = log.parent.glob("roslaunch-*.log")
    assert "[roslaunch][INFO] " in roslaunch_log.read_text()
    assert "process[seen-1]: started with pid" in roslaunch_log.read_text()


def test_a_launch_with_its_own_master_writes_logs(
    trundle: Callable[..., "subprocess.CompletedProcess[str]"], package: Path, tmp_path: Path
) -> None:
    (package / "main.launch").write_text('<launch><node pkg="tf" type="static_transform_publisher" name="s"/></launch>')
    env = {"ROS_LOG_DIR": str(tmp_path / "logs"), "ROS_PACKAGE_PATH": str(package.parent)}
    assert trundle("launch", "p", "main.launch", "--headless", "--duration", "0.5", **env).returncode == 0
    logs = tmp_path / "logs/latest"
    assert "+PUB [/rosout_agg] /rosout http://" in (logs / "master.log").read_text()
    assert "Node Startup" in (logs / "rosout.log").read_text()


def test_the_end_of_a_required_node_ends_the_launch(launch: Launch, package: Path) -> None:
    (package / "main.launch").write_text(
        '<launch><node pkg="p" type="talk" name="stays"/>'
        '<node pkg="p" type="talk" name="ends" args="0 3" required="true"/></launch>'
    )
    done = launch("p", "main.launch", "--headless")

    assert done.returncode == 1
    assert "[ends-2] process has died [exit code 3]" in done.stdout
    assert "REQUIRED process [ends-2] has died!" in done.stdout
    assert "[stays-1] killing on exit" in done.stdout


def test_a_launch_succeeds_if_its_required_node_does(launch: Launch, package: Path) -> None:
    (package / "main.launch").write_text(
        '<launch><node pkg="p" type="talk" name="ends" args="0 0" required="true"/></launch>'
    )
    done = launch("p", "main.launch", "--headless")

    assert done.returncode == 0
    assert "REQUIRED process [ends-1] has died!" in done.stdout


@pytest.mark.real_ros
def test_a_script_finds_debians_rospy_in_an_active_virtual_environment(launch: Launch, package: Path) -> None:
    (package / "main.launch").write_text(
        '<launch><node pkg="p" type="asks.py" name="asks" output="screen" required="true"/></launch>'
    )
    script = package / "asks.py"
    script.write_text("#!/usr/bin/env python3\nimport rospy\nrospy.init_node('x')\nprint('I am', rospy.get_name())\n")
    script.chmod(0o755)
    active = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"

    assert "I am /asks" in launch("p", "main.launch", "--headless", PATH=active).stdout


def test_the_respawn_delay_of_a_dying_node_increases(start, until, package: Path) -> None:
    (package / "main.launch").write_text(
        '<launch><node pkg="p" type="talk" name="n" args="0 1" respawn="true"/></launch>'
    )
    running = start("launch", "p", "main.launch", "--headless", ROS_PACKAGE_PATH=str(package.parent))

    until("the third start", lambda: running.output().count("started with pid") == 3)
    assert "[n-1] respawning in 0.2 s" in running.output()
    assert "[n-1] respawning in 0.4 s" in running.output()
    assert running.interrupt() == 130


def test_a_second_launch_replaces_nodes_of_equal_names(start, trundle, until, package: Path) -> None:
    """As in ROS, the master shuts down the older node of a name; all other nodes continue."""
    node = '<node pkg="tf2_ros" type="static_transform_publisher" name="{0}" args="0 0 0 0 0 0 x {0}" output="screen"/>'
    for name in ("first", "second"):
        (package / f"{name}.launch").write_text(f"<launch>{node.format('shared')}{node.format(name)}</launch>")
    first = start("launch", "p", "first.launch", "--headless", ROS_PACKAGE_PATH=str(package.parent))
    until("the first launch", lambda: "publishing x to shared" in first.output())

    second = trundle(
        "launch", "p", "second.launch", "--headless", "--duration", "2", ROS_PACKAGE_PATH=str(package.parent)
    )

    assert second.returncode == 0
    assert "[shared-1] killing on exit" in second.stdout
    until("the end of the older one", lambda: "[shared-1] process has finished cleanly" in first.output())
    assert "shutdown request: [/shared] Reason: new node registered with same name" in first.output()
    assert trundle("node", "list").stdout.split() == ["/first", "/rosout"]
    assert first.interrupt() == 130


def test_a_second_launch_leaves_the_clock_of_the_first(start, trundle, until, package: Path) -> None:
    """Each follows /clock as a node of its own."""
    (package / "main.launch").write_text(
        '<launch><arg name="s" default="1000"/><param name="/use_sim_time" value="true"/>'
        '<node pkg="p" type="talk" name="$(anon n)" args="$(arg s)" output="screen"/></launch>'
    )
    first = start("launch", "p", "main.launch", "--headless", ROS_PACKAGE_PATH=str(package.parent))
    until("the first launch", lambda: "hello 1000" in first.output())

    second = trundle("launch", "p", "main.launch", "s:=0", "--headless", ROS_PACKAGE_PATH=str(package.parent))

    assert second.returncode == 0
    assert first.interrupt() == 130
    assert "shutdown request" not in first.output()


def test_a_table_lists_processes_and_stand_ins(launch: Launch, package: Path) -> None:
    (package / "main.launch").write_text(
        '<launch><node pkg="p" type="talk" name="a" args="0"/><node pkg="p" type="gone" name="b"/>'
        '<node pkg="tf2_ros" type="static_transform_publisher" name="c" args="0 0 0 0 0 0 x y" launch-prefix="nice"/>'
        '<node pkg="nodelet" type="nodelet" name="d" args="load image_proc/rectify m"/></launch>'
    )
    done = launch("p", "main.launch", "--headless", "--duration", "0.1")

    *table, nodelet = done.stdout[done.stdout.index("WHAT RUNS") :].splitlines()[1:5]
    assert table == [
        f"  process   /a  {package}/talk",
        f"  missing   /b  no executable 'gone' in {package}, and no stand-in for p/gone; its programs: talk",
        "  stand-in  /c  tf2_ros/static_transform_publisher",
    ]
    assert nodelet.startswith("  missing   /d  nodelet image_proc/rectify: compiled code without a stand-in")
    assert "node /b: no executable 'gone'" in done.stderr
    assert "node /c: launch-prefix 'nice' is not used; the stand-in runs within this process" in done.stderr


def test_an_unusable_launch_prefix_is_ignored_with_a_warning(launch: Launch, package: Path) -> None:
    """The node runs without the prefix, and its output is shown."""
    (package / "main.launch").write_text(
        '<launch><node pkg="p" type="talk" name="a" args="0" launch-prefix="no_such_debugger -ex run --args"/>'
        '<node pkg="p" type="talk" name="b" args="0" launch-prefix="env A=1"/></launch>'
    )
    done = launch("p", "main.launch", "--headless", "--duration", "0.1")

    start = f"{package / 'main.launch'}:1: warning: node /a: "
    prefix = "launch-prefix 'no_such_debugger -ex run --args' is left out: there is no no_such_debugger here"
    assert start + prefix in done.stderr
    assert "/b: launch-prefix" not in done.stderr
    assert "hello 0 __name:=a" in done.stdout
    assert "hello 0 __name:=b" not in done.stdout, "its output is in the log"


def test_rosparam_dump_and_delete_run_before_parameters_are_set(launch: Launch, trundle, package: Path) -> None:
    """As in roslaunch; launch files use it to clear a node's old parameters."""
    (package / "main.launch").write_text(
        '<launch><param name="costs/fresh" value="1"/><rosparam command="dump" file="$(dirname)/were.yaml"/>'
        '<rosparam command="delete" param="/costs"/><node pkg="p" type="talk" name="a" args="0"/></launch>'
    )
    assert trundle("param", "set", "/costs/stale", "2").returncode == 0
    assert launch("p", "main.launch", "--headless").returncode == 0

    assert trundle("param", "get", "/costs").stdout.split() == ["fresh:", "1"]
    assert yaml.safe_load((package / "were.yaml").read_text())["costs"] == {"stale": 2}


def test_the_table_has_the_address_of_the_page(launch: Launch, package: Path) -> None:
    (package / "main.launch").write_text('<launch><node pkg="rviz" type="rviz" name="see"/></launch>')
    done = launch("p", "main.launch", "--duration", "0.1", "--view-port", "0")

    table = done.stdout[done.stdout.index("WHAT RUNS") :].splitlines()[1:3]
    assert table[0] == "  stand-in  /see  rviz/rviz"
    assert table[1].startswith("  page      http://127.0.0.1:")
    assert table[1].split()[1] in done.stderr


def test_a_launch_file_is_read_from_standard_input(env: dict[str, str], package: Path) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "trundle", "launch", "-", "--nodes"],
        input='<launch><node pkg="p" type="talk" name="n"/></launch>',
        env={**env, "ROS_PACKAGE_PATH": str(package.parent)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout) == (0, "/n\n")


def test_a_launch_can_wait_for_a_master(start, until, env: dict[str, str], package: Path, tmp_path: Path) -> None:
    pid = tmp_path / "pid"
    words = ("launch", "p", "main.launch", "need:=1", "--headless", "--wait", "--pid", str(pid))
    running = start(*words, ROS_PACKAGE_PATH=str(package.parent))
    until("it to wait", lambda: "will wait for it to start" in running.output())
    start("core", "--port", env["ROS_MASTER_URI"].rpartition(":")[2])
    until("a node", lambda: "started with pid" in running.output())

    assert int(pid.read_text()) == running.process.pid
    assert running.interrupt() == 130
    assert not pid.exists()


def test_a_launch_without_nodes_sets_its_parameters_and_ends(launch: Launch, trundle, package: Path) -> None:
    (package / "noop.launch").write_text('<launch><param name="noop" value="5"/></launch>')

    assert launch("p", "noop.launch", "--wait").returncode == 0

    assert trundle("param", "get", "/noop").stdout == "5\n"


def test_only_nodes_of_this_machine_are_started(launch: Launch, package: Path) -> None:
    (package / "main.launch").write_text(
        '<launch><node pkg="p" type="talk" name="there" machine="far" args="0"/>'
        '<node pkg="p" type="talk" name="here" machine="near" args="0"/>'
        '<machine name="far" address="robot.example"/><machine name="near" address="127.0.0.1" user="u"/></launch>'
    )
    done = launch("p", "main.launch", "--headless")

    assert done.returncode == 0
    assert "node /there: robot.example is another machine, and nothing is started there" in done.stderr
    assert "process[here-2]: started" in done.stdout
    assert "there-1" not in done.stdout


@pytest.mark.parametrize("words", [("launch", "a.launch"), ("launch", "a.launch", "--wait"), ("run", "model://rp2w")])
def test_one_sigint_ends_the_wait_for_a_silent_master(start, tmp_path: Path, words: tuple[str, ...]) -> None:
    (tmp_path / "a.launch").write_text('<launch><node pkg="topic_tools" type="relay" name="r" args="a b"/></launch>')
    with socket.create_server(("127.0.0.1", 0)) as silent:
        running = start(*words, "--headless", ROS_MASTER_URI=f"http://127.0.0.1:{silent.getsockname()[1]}")
        with silent.accept()[0] as connection:
            connection.recv(1)
            assert running.interrupt() == 130


@pytest.mark.parametrize("source", ["argument", "environment"])
def test_a_launch_can_have_a_namespace(trundle, package: Path, source: str) -> None:
    words, env = (("__ns:=deep",), {}) if source == "argument" else ((), {"ROS_NAMESPACE": "/deep"})
    (package / "main.launch").write_text('<launch><node pkg="p" type="talk" name="n"/></launch>')

    assert trundle("launch", str(package / "main.launch"), "--nodes", *words, **env).stdout == "/deep/n\n"


def test_an_argument_applies_to_all_files_that_declare_it(launch: Launch, package: Path) -> None:
    files = (str(package / "main.launch"), str(package / "other.launch"))
    (package / "other.launch").write_text('<launch><node pkg="p" type="talk" name="six"/></launch>')

    assert launch("--nodes", *files, "need:=1").stdout.splitlines()[-2:] == ["/six", "/tt"]
    assert "no argument 'nead' to set" in launch("--nodes", *files, "need:=1", "nead:=1").stderr


@pytest.mark.parametrize(
    ("words", "code"),
    [((), 2), (("--nodes",), 2), (("--core", "a.launch"), 2), (("a.launch", "--sigint-timeout", "0"), 1)],
)
def test_exit_codes_of_wrong_usage_and_invalid_values(trundle, words: tuple[str, ...], code: int) -> None:
    done = trundle("launch", *words)
    assert (done.returncode, done.stdout) == (code, "")
    assert "trundle launch: error: " in done.stderr


def test_options_can_be_between_positional_arguments(launch: Launch, package: Path) -> None:
    done = launch("p", "--nodes", "main.launch", "--no-summary", "need:=1")
    assert done.stdout.splitlines() == ["/sub/one", "/two", "/five", "/tt"]


def test_a_node_of_an_undefined_machine_is_an_error(launch: Launch, package: Path) -> None:
    (package / "main.launch").write_text('<launch>\n<node pkg="p" type="talk" name="n" machine="far"/></launch>')
    done = launch("p", "main.launch", "--headless")

    assert done.returncode == 1
    assert "main.launch:2: error: node 'n': there is no machine 'far'" in done.stderr
    assert launch("p", "main.launch", "--nodes").returncode == 0


def test_a_null_parameter_is_skipped_with_a_warning(launch: Launch, trundle, package: Path) -> None:
    (package / "main.launch").write_text("<launch><rosparam>{a: ~, b: 1}</rosparam></launch>")
    done = launch("p", "main.launch", "--headless", "--duration", "0.1")

    assert "parameter '/a' is null, which ROS parameters cannot be; it is not set" in done.stderr
    assert trundle("param", "list").stdout.split()[:1] == ["/b"]


def test_quiet_keeps_output_of_nodes_and_failures(launch: Launch, package: Path) -> None:
    (package / "main.launch").write_text(
        '<launch><node pkg="p" type="talk" name="a" args="0" output="screen"/>'
        '<node pkg="p" type="talk" name="b" args="0 3"/></launch>'
    )
    done = launch("p", "main.launch", "--headless", "-q")

    lines = [line for line in done.stdout.splitlines() if not line.startswith(" ")]
    assert len(lines) == 3
    assert [line.startswith("hello 0") for line in lines].count(True) == 1  # before or after the messages about b
    messages = [line for line in lines if not line.startswith("hello 0")]
    assert messages[0] == "[b-2] process has died [exit code 3]; its last output:"
    assert messages[1].startswith("log file: ")
    assert done.stderr == ""


@pytest.mark.slow
@pytest.mark.parametrize(("distro", "topic"), [("indigo", "/tf"), ("noetic", "/tf_static")])
def test_fixed_joints_are_published_like_in_the_distribution(
    launch: Launch, trundle, package: Path, tmp_path: Path, distro: str, topic: str
) -> None:
    """Up to Indigo, transforms of fixed joints were sent repeatedly; --record has every topic."""
    (package / "main.launch").write_text(
        """<launch><param name="robot_description" textfile="$(dirname)/r.urdf"/>
        <node pkg="robot_state_publisher" type="robot_state_publisher" name="rsp"/></launch>"""
    )
    (package / "r.urdf").write_text(
        '<robot name="r"><link name="a"/><link name="b"/>'
        '<joint name="j" type="fixed"><parent link="a"/><child link="b"/></joint></robot>'
    )
    bag = tmp_path / "out.bag"
    done = launch("p", "main.launch", "--headless", "--duration", "8", "--distro", distro, "--record", str(bag))

    assert done.returncode == 0
    assert f" * /rosdistro: {distro}\n" in done.stdout
    topics = trundle("bag", "info", str(bag)).stdout.partition("topics:")[2]
    assert re.findall(r"/tf\w*", topics) == [topic]


@pytest.mark.parametrize("words", [(), ("--speed", "max")])
def test_a_launch_does_not_overwrite_an_active_recording(
    start, trundle, until, package: Path, tmp_path: Path, words: tuple[str, ...]
) -> None:
    """With lockstep and without."""
    (package / "main.launch").write_text(
        '<launch><node pkg="tf2_ros" type="static_transform_publisher" name="s" args="0 0 0 0 0 0 a b"/></launch>'
    )
    bag = tmp_path / "out.bag"
    common = ("launch", str(package / "main.launch"), "--headless", "--record", str(bag))
    first = start(*common)
    until("the recording to begin", lambda: bag.with_name("out.bag.active").exists())
    second = trundle(*common, "--duration", "1", *words, "-p", "0")
    assert second.returncode == 1
    refused = rf"trundle launch: error: {bag} cannot be written: .* writes it: end that, or choose another name"
    assert re.fullmatch(refused, second.stderr.splitlines()[-1])
    until("the transform", lambda: "/tf_static" in bag.with_name("out.bag.active").read_text(errors="replace"))
    first.interrupt()
    assert "/tf_static" in trundle("bag", "info", str(bag)).stdout
    assert [path.name for path in tmp_path.iterdir() if "out.bag" in path.name] == ["out.bag"]


@pytest.mark.slow
def test_speed_max_runs_faster_than_real_time(launch: Launch, package: Path) -> None:
    (package / "main.launch").write_text(
        '<launch><include file="$(find gazebo_ros)/launch/empty_world.launch"/></launch>'
    )
    done = launch("p", "main.launch", "--headless", "--duration", "300", "--speed", "max")

    assert done.returncode == 0  # within the timeout of a minute


@pytest.mark.slow
def test_bags_of_a_world_that_starts_paused_are_identical(launch: Launch, package: Path, tmp_path: Path) -> None:
    """The start times of nodes have no effect: a recording with --speed max has no wall time."""
    (package / "ball.sdf").write_text(_BALL)
    (package / "main.launch").write_text(
        '<launch><include file="$(find gazebo_ros)/launch/empty_world.launch"><arg name="paused" value="true"/>'
        '</include><node name="spawn" pkg="gazebo_ros" type="spawn_model"'
        ' args="-sdf -file $(dirname)/ball.sdf -model ball -z 1 -unpause"/></launch>'
    )
    bags = [tmp_path / f"{number}.bag" for number in (1, 2)]
    for number, bag in enumerate(bags):
        words = ("--headless", "--speed", "max", "--duration", "0.5", "--record", str(bag))
        assert launch("p", "main.launch", *words, PYTHONHASHSEED=str(number)).returncode == 0

    assert bags[0].read_bytes() == bags[1].read_bytes()
    with open_bag(bags[0]) as bag:
        counts = {c.topic: count for c, count in zip(bag.connections, bag.counts, strict=True)}
    assert counts["/clock"] == 50
    assert 40 < counts["/gazebo/model_states"] < 60


def test_a_gazebo_launch_file_simulates_its_robot_without_gazebo(start, trundle, until, package: Path) -> None:
    (package / "ball.sdf").write_text(_BALL)
    (package / "main.launch").write_text(
        '<launch><include file="$(find gazebo_ros)/launch/empty_world.launch"/>'
        '<node name="spawn" pkg="gazebo_ros" type="spawn_model"'
        ' args="-sdf -file $(dirname)/ball.sdf -model ball -z 1"/>'
        "</launch>"
    )
    running = start("launch", "p", "main.launch", "--headless", ROS_PACKAGE_PATH=str(package.parent))

    def state() -> str:
        return trundle("service", "call", "/gazebo/get_model_state", "{model_name: ball}").stdout

    until("the ball on the ground", lambda: "z: 0.1" in state() or "z: 0.09" in state())
    assert "stand-in  /gazebo" in running.output()
    assert trundle("param", "get", "/use_sim_time").stdout == "true\n"
    assert running.interrupt() == 130
    assert "Traceback" not in running.output()


def test_a_missing_world_is_replaced_by_the_empty_world(launch: Launch, package: Path) -> None:
    """Jackal's empty_world.launch names a world that gazebo_ros never had; gzserver uses its empty world."""
    (package / "main.launch").write_text(
        '<launch><include file="$(find gazebo_ros)/launch/empty_world.launch">'
        '<arg name="world_name" value="worlds/nowhere.world"/><arg name="server_required" value="true"/></include>'
        "</launch>"
    )
    done = launch("p", "main.launch", "--headless", "--duration", "0.2", "--speed", "max")

    assert done.returncode == 0
    assert "worlds/nowhere.world: no such world file; worlds/empty.world is opened in its place" in done.stderr
    assert "; others are searched along GAZEBO_RESOURCE_PATH" in done.stderr
    assert "Traceback" not in done.stderr + done.stdout


@pytest.mark.parametrize("pace", [(), ("--speed", "1")])
def test_a_launch_with_a_failed_world_ends_after_its_duration(
    launch: Launch, package: Path, pace: tuple[str, ...]
) -> None:
    (package / "bad.world").write_text("<sdf version='1.6'><world")
    (package / "main.launch").write_text(
        '<launch><include file="$(find gazebo_ros)/launch/empty_world.launch">'
        '<arg name="world_name" value="$(find p)/bad.world"/><arg name="gui" value="false"/></include>'
        '<node pkg="p" type="talk" name="stays"/></launch>'
    )
    done = launch("p", "main.launch", "--headless", "--duration", "0.5", *pace)

    assert done.returncode == 0
    assert "the simulation has ended, and ROS time with it" in done.stderr
    assert "[stays-2] killing on exit" in done.stdout


def test_output_of_a_stand_in_goes_to_screen_or_log(start, until, package: Path, tmp_path: Path) -> None:
    node = '<node pkg="tf2_ros" type="static_transform_publisher" name="{0}" args="0 0 0 0 0 0 x {0}" output="{1}"/>'
    (package / "main.launch").write_text(
        f"<launch>{node.format('loud', 'screen')}{node.format('mute', 'log')}</launch>"
    )
    folders = {"ROS_PACKAGE_PATH": str(package.parent), "ROS_LOG_DIR": str(tmp_path / "logs")}
    running = start("launch", "p", "main.launch", "--headless", **folders)
    log = tmp_path / "logs/latest/mute-2-stdout.log"

    until("the loud one", lambda: "publishing x to loud" in running.output())
    until("the log", lambda: log.is_file() and "publishing x to mute" in log.read_text())
    assert running.interrupt() == 130
    assert "publishing x to mute" not in running.output()


@pytest.mark.slow
def test_a_missing_clock_is_reported(start, until, package: Path) -> None:
    (package / "main.launch").write_text(
        '<launch><param name="/use_sim_time" value="true"/><node pkg="p" type="talk" name="n"/></launch>'
    )
    running = start("launch", "p", "main.launch", "--headless", ROS_PACKAGE_PATH=str(package.parent))

    until("the sentence", lambda: "nothing has published a time on /clock yet" in running.output())
    assert running.interrupt() == 130


def test_a_launch_file_can_set_the_model_path(start, trundle, until, package: Path, tmp_path: Path) -> None:
    model = tmp_path / "models" / "rock"
    model.mkdir(parents=True)
    (model / "model.config").write_text("<model><name>rock</name><sdf version='1.6'>model.sdf</sdf></model>")
    (model / "model.sdf").write_text("<sdf version='1.6'><model name='rock'><link name='l'/></model></sdf>")
    (package / "my.world").write_text(
        "<sdf version='1.6'><world name='w'><include><uri>model://rock</uri></include></world></sdf>"
    )
    (package / "main.launch").write_text(
        f'<launch><env name="GAZEBO_MODEL_PATH" value="{model.parent}"/>'
        '<include file="$(find gazebo_ros)/launch/empty_world.launch">'
        '<arg name="world_name" value="$(dirname)/my.world"/></include></launch>'
    )
    running = start("launch", "p", "main.launch", "--headless", ROS_PACKAGE_PATH=str(package.parent))
    models = "/gazebo/get_world_properties"
    until("the rock", lambda: "rock" in trundle("service", "call", models).stdout)
    assert running.interrupt() == 130


def test_a_script_for_python_runs_with_python3(launch: Launch, package: Path, tmp_path) -> None:
    script = package / "old.py"
    script.write_text("#!/usr/bin/env python\nimport sys\nprint('I run on Python', sys.version_info.major)\n")
    script.chmod(0o755)
    (package / "main.launch").write_text('<launch><node pkg="p" type="old.py" name="old" output="screen"/></launch>')
    done = launch("p", "main.launch", "--headless", PATH=str(tmp_path))

    assert "I run on Python 3" in done.stdout
    assert done.returncode == 0


def test_a_launchs_master_runs_on_after_the_last_node(start, trundle: Launch, until, package: Path) -> None:
    file = package / "main.launch"
    file.write_text('<launch><param name="kept" value="3"/><node pkg="p" type="talk" name="a" args="0"/></launch>')
    launched = start("launch", str(file), "--headless", ROS_PACKAGE_PATH=str(package.parent))
    until("the node to end", lambda: "[a-1] process has finished cleanly" in launched.output())

    assert trundle("param", "get", "/kept").stdout == "3\n"
    assert launched.interrupt() == 130


def test_nodes_are_stopped_after_the_output_pipe_is_closed(env: dict[str, str], package: Path, until) -> None:
    """`trundle launch … | tee log`: Ctrl-C also ends tee, often first."""
    (package / "main.launch").write_text(
        '<launch><node pkg="p" type="talk" name="a"/><node pkg="tf2_ros" type="static_transform_publisher" name="b"'
        ' args="0 0 0 0 0 0 x y"/></launch>'
    )
    words = [sys.executable, "-m", "trundle", "launch", "p", "main.launch", "--headless"]
    pipe = subprocess.PIPE
    with subprocess.Popen(
        words, env={**env, "ROS_PACKAGE_PATH": str(package.parent)}, stdout=pipe, stderr=pipe, text=True
    ) as launched:
        assert launched.stdout is not None
        assert launched.stderr is not None
        output = ""
        while "process[b-2]" not in output:
            output += launched.stdout.readline()
        talk = int(output.partition("started with pid [")[2].partition("]")[0])
        launched.stdout.close()
        launched.stderr.close()
        launched.send_signal(signal.SIGINT)
        assert launched.wait(60) == 130

    with pytest.raises(ProcessLookupError):
        os.kill(talk, 0)


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="/proc, which shows who lives, is Linux's")
def test_nodes_end_with_a_killed_launch(start, package: Path, tmp_path: Path, until) -> None:
    """Also a node without output, its child processes, and stand-ins that are processes."""
    script = package / "mute"
    script.write_text('#!/bin/sh\nsetsid sleep 600 &\necho $! $$ > "$1"\nwait\n')
    script.chmod(0o755)
    told, bag = tmp_path / "pids", tmp_path / "a.bag.active"
    (package / "main.launch").write_text(
        f'<launch><node pkg="p" type="mute" name="a" args="{told}"/>'
        f'<node pkg="rosbag" type="record" name="b" args="-a -O {bag.with_suffix("")}"/></launch>'
    )
    running = start("launch", "p", "main.launch", "--headless", ROS_PACKAGE_PATH=str(package.parent))
    until("both to run", lambda: told.exists() and len(told.read_text().split()) == 2 and bag.exists())
    recorder = [
        int(entry.name)
        for entry in Path("/proc").iterdir()
        if entry.name.isdecimal() and str(bag.with_suffix("")) in (entry / "cmdline").read_text()
    ]
    assert len(recorder) == 1
    running.process.kill()

    for pid in (*map(int, told.read_text().split()), *recorder):
        until(
            "its end",
            lambda pid=pid: not (status := Path(f"/proc/{pid}/status")).exists() or "Z (z" in status.read_text(),
        )
