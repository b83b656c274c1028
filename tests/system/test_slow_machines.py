"""Launches on a machine that is twenty times slower have the same nodes, robots and bags."""

import os
import re
import sys
from collections.abc import Sequence
from pathlib import Path

import pytest
from tests.cpu_quota import slowed
from tests.graphs import free_port

from trundle.ros import GraphLoop, Message, Node, open_bag

_RATIO = 0.05
_PATIENCE_S = 1500.0
_BUSY_LOOPS = 4
_REPOS = "corpus/repos"
_LAUNCHES = (
    "ros+urdf_tutorial/launch/display.launch",
    "ROBOTIS-GIT+turtlebot3_simulations/turtlebot3_gazebo/launch/turtlebot3_stage_4.launch",
    "husky+husky/husky_gazebo/launch/empty_world.launch",
)
"""A robot without a simulation, a robot in a world, and a robot with controller spawners."""
_FAILED = re.compile(r"\[FATAL\]|Traceback|has died|cannot be started|does not arrive while time is held")
_WORLD = """<launch><node pkg="gazebo_ros" type="gzserver" name="gazebo" args="worlds/empty.world"/></launch>"""


def _environment(home: Path, packages: Sequence[Path]) -> dict[str, str]:
    home.mkdir()
    return {
        **{key: value for key, value in os.environ.items() if not key.startswith(("ROS_", "GAZEBO_"))},
        "HOME": str(home),
        "ROS_PACKAGE_PATH": ":".join(map(str, packages)),
        "ROS_MASTER_URI": f"http://127.0.0.1:{free_port()}",
        "TURTLEBOT3_MODEL": "burger",
    }


def _launched(file: Path, home: Path, packages: Sequence[Path], *, ratio: float) -> tuple[list[str], bytes]:
    """Run a launch to its end; return its table of nodes, and its bag."""
    env = _environment(home, packages)
    bag, log = home / "out.bag", home / "log"
    words = ["launch", str(file), "--headless", "--speed", "max", "--duration", "1", "--record", str(bag)]
    with log.open("w") as out, slowed([sys.executable, "-m", "trundle", *words], ratio=ratio, env=env, log=out) as run:
        code = run.wait(_PATIENCE_S)
    text = log.read_text(errors="replace")
    assert code == 0, text
    assert [line for line in text.splitlines() if _FAILED.search(line)] == []
    table = re.findall(r"^  (process|stand-in|missing|failed) +(\S+)", text.partition("WHAT RUNS")[2], re.M)
    return [f"{kind} {re.sub('_[0-9]+', '', name)}" for kind, name in table], bag.read_bytes()


@pytest.mark.slow
@pytest.mark.parametrize("name", _LAUNCHES, ids=lambda name: Path(name).parent.parent.name)
def test_a_slow_machine_runs_the_same_nodes_and_records_the_same_bag(shared: Path, tmp_path: Path, name: str) -> None:
    repos = shared / _REPOS
    if not repos.is_dir():
        pytest.skip("the published launch files (../shared/corpus) are not beside this checkout")
    repository = repos / name.partition("/")[0]
    packages = [repository, repos, *_not_mounted(tmp_path)]

    nodes, bag = _launched(repos / name, tmp_path / "fast", packages, ratio=1.0)
    slow_nodes, slow_bag = _launched(repos / name, tmp_path / "slow", packages, ratio=_RATIO)

    assert len(nodes) >= 2
    assert slow_nodes == nodes
    assert slow_bag == bag
    with open_bag(tmp_path / "slow" / "out.bag") as reader:
        assert len(list(reader.messages())) > 10


def _not_mounted(folder: Path) -> list[Path]:
    """Write the packages of optional accessories that Husky's xacro includes."""
    for name in ("fath_pivot_mount_description/urdf/lockmount", "flir_camera_description/urdf/flir_blackflys"):
        file = folder / "not_mounted" / f"{name}.urdf.xacro"
        file.parent.mkdir(parents=True)
        file.write_text("<robot/>")
        package = file.parents[1]
        (package / "package.xml").write_text(f"<package><name>{package.name}</name></package>")
    lidar = folder / "not_mounted/lms1xx/urdf/sick_lms1xx.urdf.xacro"
    lidar.parent.mkdir(parents=True)
    lidar.write_text("<robot/>")
    (lidar.parents[1] / "package.xml").write_text("<package><name>lms1xx</name></package>")
    return [folder / "not_mounted"]


@pytest.mark.slow
def test_first_calls_of_gazebos_services_succeed_on_a_busy_machine(tmp_path: Path) -> None:
    """Each service is called as soon as it is registered, while busy loops share the CPU with the launch."""
    file = tmp_path / "w.launch"
    file.write_text(_WORLD)
    env = _environment(tmp_path / "home", [])
    words = f'for i in $(seq {_BUSY_LOOPS}); do sh -c "while :; do :; done" & done; exec "$@"'
    command = ["/bin/sh", "-c", words, "sh", sys.executable, "-m", "trundle", "launch", str(file), "--headless"]
    services = {
        "get_world_properties": "gazebo_msgs/GetWorldProperties",
        "get_physics_properties": "gazebo_msgs/GetPhysicsProperties",
        "pause_physics": "std_srvs/Empty",
        "unpause_physics": "std_srvs/Empty",
        "reset_world": "std_srvs/Empty",
    }
    with (
        (tmp_path / "log").open("w") as log,
        slowed(command, ratio=0.3, env=env, log=log),
        GraphLoop() as loop,
    ):
        node = Node("/caller", loop=loop, master_uri=env["ROS_MASTER_URI"])

        async def call(service: str, kind: str) -> Message:
            await node.wait_for_service(f"/gazebo/{service}")
            return await node.call_service(f"/gazebo/{service}", kind)

        calls = {name: loop.spawn(call(name, kind)) for name, kind in services.items()}
        answers = {name: future.result(_PATIENCE_S) for name, future in calls.items()}
        loop.run(node.shutdown(), 60.0)
    assert answers["get_world_properties"].success
    assert answers["get_physics_properties"].success
