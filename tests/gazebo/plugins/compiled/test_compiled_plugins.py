"""Plugins of Gazebo in C++, compiled as its tutorials do, in a run of the first tutorial's robot."""

import os
import re
import shutil
import signal
import subprocess
import sys
import sysconfig
from pathlib import Path

import pytest
from msgspec.structs import replace
from tests.graphs import running_graph, until

import trundle
from trundle.base.diagnostics import UsageError
from trundle.live.live_world import LiveWorld
from trundle.robots.packages import Packages
from trundle.ros.sdk import find_toolchain
from trundle.spatial import Pose

pytestmark = pytest.mark.slow
_ROOT = Path(__file__).parents[4]
_SOURCES = _ROOT / "tests/data/gazebo_plugins"
_WAIT_S = 1800  # the first to come compiles the kit


def environment(**variables: str) -> dict[str, str]:
    """Return variables with CMake's programs on PATH, and nothing that names plugins."""
    path = os.pathsep.join([sysconfig.get_path("scripts"), os.environ["PATH"]])
    left_out = ("GAZEBO_PLUGIN_PATH", "CMAKE_PREFIX_PATH", "LD_LIBRARY_PATH", "ROS_MASTER_URI")
    kept = {name: value for name, value in os.environ.items() if name not in left_out}
    return {**kept, "PATH": path, **variables}


def command(*words: str, cwd: Path, **variables: str) -> "subprocess.CompletedProcess[str]":
    return subprocess.run(
        [sys.executable, "-m", "trundle", *words],
        cwd=cwd,
        env=environment(PWD=str(cwd), **variables),
        capture_output=True,
        text=True,
        check=False,
        timeout=_WAIT_S,
    )


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a plugin after `cmake .. && make` in its `build`."""
    try:
        find_toolchain(os.environ)
    except UsageError as error:
        pytest.skip(str(error))
    if shutil.which("make") is None:
        pytest.skip("there is no make")
    folder = tmp_path_factory.mktemp("plugin") / "rp2w_plugin"
    shutil.copytree(_SOURCES / "drive", folder)
    (folder / "build").mkdir()
    done = subprocess.run(
        [sys.executable, "-m", "trundle", "shell", "-c", "cmake .. && make"],
        cwd=folder / "build",
        env=environment(PWD=str(folder / "build")),
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return folder


def robot(folder: Path, plugin: str) -> Path:
    """Write the RP2W with another plugin element; return its file."""
    text = (_ROOT / "examples/rp2w/model.sdf").read_text()
    text, count = re.subn(r"<plugin [^>]*/>", plugin, text)
    assert count == 1
    folder.mkdir(exist_ok=True)
    (folder / "model.sdf").write_text(text)
    return folder / "model.sdf"


def run(file: Path, *options: str, **variables: str) -> "subprocess.CompletedProcess[str]":
    words = ("run", file.name, "--headless", "--duration", "3", "--speed", "max", *options)
    return command(*words, cwd=file.parent, **variables)


def test_the_robot_drives(built: Path, tmp_path: Path) -> None:
    """2 rad/s · 0.0635 m · 3 s along -y, from a library on GAZEBO_PLUGIN_PATH."""
    file = robot(tmp_path / "rp2w", '<plugin name="rp2w" filename="/home/author/librp2w.so"/>')

    done = run(file, "--no-ros", GAZEBO_PLUGIN_PATH=str(built / "build"))

    output = done.stdout + done.stderr
    assert f"plugin 'rp2w' of rp2w: {built}/build/librp2w.so, in C++\n" in output
    assert "[Msg] driving rp2w with 6 joints\n" in output
    at = re.search(r"after 2 s: (\S+) (\S+) yaw (\S+), wheel (\S+) rad/s", output)
    assert at is not None, output
    assert [float(word) for word in at.groups()] == pytest.approx([0.0, -0.254, 0.0, 2.0], abs=0.01)
    stands = re.search(r"rp2w stands at x (\S+), y (\S+), ", output)
    assert stands is not None, output
    assert float(stands[2]) == pytest.approx(-0.381, abs=0.01)
    assert done.returncode == 0


def test_its_parameters_are_read(built: Path, tmp_path: Path) -> None:
    plugin = '<plugin name="rp2w" filename="librp2w.so"><speed> -1.0 </speed></plugin>'
    file = robot(tmp_path / "rp2w", plugin)
    shutil.copy(built / "build/librp2w.so", file.parent)

    done = run(file, "--no-ros")

    stands = re.search(r"rp2w stands at x (\S+), y (\S+), ", done.stdout)
    assert stands is not None, done.stdout + done.stderr
    assert float(stands[2]) == pytest.approx(0.19, abs=0.01)


def test_the_interface_says_and_does_what_is_documented(built: Path) -> None:
    """A world plugin with checks of SDF, mathematics, poses, velocities, forces, joints, topics and events."""
    done = run(_SOURCES / "drive/checks.world", "--no-ros", GAZEBO_PLUGIN_PATH=str(built / "build"))

    assert re.search(r"^14\d\d checks, 0 failed$", done.stdout, re.MULTILINE), done.stdout + done.stderr


def test_a_plugin_switches_between_the_profiles_of_the_physics(built: Path) -> None:
    """Both <physics> of a world and one that the plugin makes; step and gravity follow, ODE's iterations do not."""
    done = run(_SOURCES / "drive/presets.world", "--no-ros", GAZEBO_PLUGIN_PATH=str(built / "build"))

    said = [line for line in done.stdout.splitlines() if re.match(r"(profile|earth|mine|before|deep|re|s|it)", line)]
    assert said[:14] == [
        "profile earth",
        "profile moon",
        "earth at 1000 Hz",
        "mine: 1 0 0.004 ode",
        "before: 0.001",
        "deep: 70 0.001",
        "removed: 0 0",
        "step 1: earth, 0.001 s, -9.8",
        "switched: 1",
        "step 8: moon, 0.002 s, -1.6",
        "set: 1",
        "iterations: 0",
        "step 18: moon, 0.005 s, -1.6",
        "step 28: earth, 0.001 s, -9.8",
    ], done.stdout + done.stderr
    assert "iters of the physics is not set" in done.stderr


def test_elevators_and_harnesses_work(built: Path) -> None:
    """A lift goes to the floor at 2 m, opens and shuts; a load is pulled up by 0.5 m, held, and falls."""
    words = ("run", "machines.world", "--headless", "--duration", "8", "--speed", "max", "--no-ros")
    done = command(*words, cwd=_SOURCES / "drive", GAZEBO_PLUGIN_PATH=str(built / "build"))

    at = {(name, int(step)): text for name, step, text in re.findall(r"^(\w+) at (\d+): (.*)", done.stdout, re.M)}
    height = float(at["load", 2000].split()[0])
    assert height == pytest.approx(10.5, abs=0.05), done.stdout + done.stderr
    assert float(at["load", 1500]) == pytest.approx(height, abs=0.02)
    assert float(at["load", 2500]) == pytest.approx(height - 9.8 * 0.5**2 / 2, abs=0.05)
    lift = [tuple(map(float, text.split())) for (name, _), text in at.items() if name == "lift"]
    assert max(door for _, door in lift) > 0.9, lift
    assert lift[0] == (1.0, 0.0)
    assert lift[-1] == pytest.approx((3.0, 0.0), abs=0.1)


def test_a_plugin_of_a_visual_draws_lines_and_changes_it(built: Path) -> None:
    file = _SOURCES / "drive/machines.world"
    variables = {"GAZEBO_PLUGIN_PATH": str(built / "build")}
    sim = trundle.load(str(file))
    packages = Packages(variables, start=file)
    live = LiveWorld(sim, packages=packages, environment=variables, say=lambda _: None, has_sensors=False)
    live.load_plugins()

    live.advance(200_000_000)
    (line,) = sim.lines.values()
    # From the ball's middle along the link's x, which is the world's y, by its diameter.
    assert line.points == [pytest.approx((0.0, 5.0, 2.0)), pytest.approx((0.0, 5.5, 2.0))]
    assert line.rgb == pytest.approx((0.0, 1.0, 0.0))

    live.advance(1_000_000_000)
    (line,) = sim.lines.values()
    assert line.points == [pytest.approx((0.0, 5.0, 1.5)), pytest.approx((0.0, 5.0, 2.5))]
    assert line.rgb[2] > line.rgb[1]
    visual = sim["marked"].model.links[0].visuals[0]
    assert (visual.link_from_visual.position, visual.transparency) == (pytest.approx((0.0, 0.0, 0.5)), 0.5)

    live.advance(2_000_000_000)
    assert sim["marked"].model.links[0].visuals[0].transparency == 1.0
    live.delete("marked")
    live.advance(2_010_000_000)
    assert sim.lines == {}
    assert sim.report.warnings == []


def test_it_follows_the_simulation_in_time_and_through_changes(built: Path, tmp_path: Path) -> None:
    """Going back, resets, and a second robot with the same plugin, after which the first is deleted."""
    file = robot(tmp_path / "rp2w", '<plugin name="rp2w" filename="librp2w.so"/>')
    variables = {"GAZEBO_PLUGIN_PATH": str(built / "build")}
    sim = trundle.load(str(file))
    packages = Packages(variables, start=file)
    live = LiveWorld(sim, packages=packages, environment=variables, say=lambda _: None, has_sensors=False)
    live.load_plugins()
    live.keep_timeline(50_000_000)

    live.advance(2_000_000_000)
    before = sim["rp2w"].pose
    assert before.position[1] == pytest.approx(-0.254, abs=0.005)
    assert live.timeline is not None
    live.timeline.seek(1_000_000_000)
    live.advance(2_000_000_000)
    assert sim["rp2w"].pose == before

    sim.reset()
    live.advance(1_000_000_000)
    assert sim["rp2w"].pose.position[1] == pytest.approx(-0.127, abs=0.005)

    (model,) = [model for model in sim.world.models if model.name == "rp2w"]
    live.spawn(replace(model, name="second", world_from_model=Pose((2.0, 0.0, 0.0))))
    live.advance(2_000_000_000)
    live.delete("rp2w")
    live.advance(3_000_000_000)
    assert sim["second"].pose.position == pytest.approx((2.0, -0.254, 0.0), abs=0.005)
    assert sim.report.warnings == []


def fault(built: Path, folder: Path, kind: str) -> "subprocess.CompletedProcess[str]":
    plugin = f'<plugin name="bad" filename="libfaulty.so"><fault>{kind}</fault></plugin>'
    return run(robot(folder / "rp2w", plugin), "--no-ros", GAZEBO_PLUGIN_PATH=str(built / "build"))


def test_an_exception_in_load_is_a_sentence(built: Path, tmp_path: Path) -> None:
    done = fault(built, tmp_path, "load")

    library = built / "build/libfaulty.so"
    assert f"warning: plugin 'bad': {library}: no wheels; the run goes on without it" in done.stderr + done.stdout
    assert done.returncode == 0


def test_an_exception_in_an_update_is_a_sentence(built: Path, tmp_path: Path) -> None:
    done = fault(built, tmp_path, "update")

    output = done.stderr + done.stdout
    fault_text = "joint 7 is gone; the run goes on without this function of it"
    assert f"model.sdf:224: warning: plugin 'bad': {fault_text}" in output
    assert output.count("joint 7 is gone") == 1
    assert "3.000 s simulated" in output
    assert done.returncode == 0


@pytest.mark.parametrize(
    ("kind", "words"),
    [
        ("crash", "trundle: error: plugin 'bad' crashed in its C++ code (SIGSEGV)"),
        ("parameter", "it looked for a parameter that is missing: <plugin> has no <radius>"),
        ("destructor", "plugin 'bad' crashed in its C++ code (SIGSEGV); before that its Load threw: no wheels;"),
    ],
)
def test_a_crash_names_its_plugin_and_what_came_before(built: Path, tmp_path: Path, kind: str, words: str) -> None:
    done = fault(built, tmp_path, kind)

    assert words in done.stderr
    assert done.returncode == -signal.SIGSEGV


def test_a_crash_of_the_destructor_at_the_end_names_its_plugin(built: Path, tmp_path: Path) -> None:
    done = fault(built, tmp_path, "end")

    assert "3.000 s simulated" in done.stdout + done.stderr
    assert "plugin 'bad' crashed in its C++ code (SIGSEGV)" in done.stderr


@pytest.mark.parametrize("words", [("check",), ("convert", "--to", "urdf")])
def test_other_commands_load_none(built: Path, tmp_path: Path, words: tuple[str, ...]) -> None:
    file = robot(tmp_path / "rp2w", '<plugin name="bad" filename="libfaulty.so"><fault>parameter</fault></plugin>')

    done = command(words[0], file.name, *words[1:], cwd=file.parent, GAZEBO_PLUGIN_PATH=str(built / "build"))

    assert "crashed" not in done.stderr
    assert "no libfaulty.so" not in done.stderr + done.stdout
    assert done.returncode >= 0


def test_a_plugin_that_is_a_node_follows_cmd_vel(built: Path, tmp_path: Path) -> None:
    """Compiled by catkin_make, with a queue and a thread of its own, as gazebo_ros' plugins are."""
    workspace = tmp_path / "ws"
    shutil.copytree(_SOURCES / "rp2w_cpp", workspace / "src/rp2w_cpp")
    made = command("--as", "catkin_make", cwd=workspace)
    assert "library rp2w (src/rp2w.cpp; src/rp2w_cpp/CMakeLists.txt:7): built: " in made.stdout, (
        made.stdout + made.stderr
    )
    plugin = '<plugin name="rp2w" filename="librp2w.so"><robotNamespace>/rp2w</robotNamespace></plugin>'
    file = robot(workspace / "src/rp2w_cpp/model", plugin)

    poses: list[float] = []
    with running_graph() as graph:
        node = graph.node("driver")
        node.subscribe(
            "/rp2w/odom_cpp", "nav_msgs/Odometry", lambda message: poses.append(message.pose.pose.position.y)
        )
        commands = node.advertise("/rp2w/cmd_vel", "geometry_msgs/Twist")
        process = subprocess.Popen(
            [sys.executable, "-m", "trundle", "run", file.name, "--headless", "--duration", "60"],
            cwd=file.parent,
            env=environment(ROS_MASTER_URI=graph.core.uri),
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )
        try:
            until(lambda: poses)

            def has_driven() -> bool:
                commands.publish({"linear": {"x": 0.3, "y": 0.0, "z": 0.0}, "angular": {"x": 0.0, "y": 0.0, "z": 0.0}})
                return abs(poses[-1]) > 0.2

            until(has_driven)
        finally:
            process.send_signal(signal.SIGINT)
            output, _ = process.communicate(timeout=_WAIT_S)
    assert "crashed" not in output
    assert process.returncode == 130, output
