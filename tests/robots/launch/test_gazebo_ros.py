"""The launch files of gazebo_ros that Trundle ships have the originals' plans."""

from pathlib import Path

import pytest

from trundle.base.diagnostics import Diagnostics
from trundle.robots.launch import LaunchPlan, read_launch
from trundle.robots.packages import Packages

_LOUD = {"paused": "true", "recording": "true", "verbose": "true", "physics": "bullet", "world_name": "/w.world"}
_ODD = {"gui": "false", "use_sim_time": "false", "debug": "true", "use_clock_frequency": "true"}


def essentials(plan: LaunchPlan) -> tuple[object, ...]:
    nodes = [(n.full_name, n.package, n.type, n.arguments.split(), n.output, n.required) for n in plan.nodes]
    return nodes, {param.name: param.value for param in plan.params}


@pytest.mark.parametrize(
    ("name", "arguments"),
    [
        *(("empty", arguments) for arguments in ({}, _LOUD, _ODD, {"gui_required": "true"})),
        *((name, {}) for name in ("shapes", "mud", "rubble", "willowgarage", "elevator")),
        ("elevator", _LOUD),
        ("elevator", {"gui": "false", "use_sim_time": "false", "debug": "true", "verbose": "false"}),
    ],
)
def test_each_world_launch_file_has_the_plan_of_the_original(
    shared: Path, name: str, arguments: dict[str, str]
) -> None:
    originals = shared / "corpus/repos/ros-simulation+gazebo_ros_pkgs"
    shipped = Packages({}, start=Path("/nonexistent")).find_package("gazebo_ros")
    original = Packages({"ROS_PACKAGE_PATH": str(originals)}, start=originals).find_package("gazebo_ros")
    assert shipped is not None
    assert original is not None
    assert original.is_relative_to(originals)

    def read(folder: Path) -> tuple[object, ...]:
        file = folder / f"launch/{name}_world.launch"
        packages = Packages({}, start=folder)
        return essentials(read_launch(file, packages=packages, report=Diagnostics(), arguments=arguments))

    assert read(shipped) == read(original)


def test_a_range_world_is_a_test_of_gazebo_plugins() -> None:
    packages = Packages({}, start=Path("/nonexistent"))
    folder = packages.find_package("gazebo_ros")
    assert folder is not None
    file, arguments = folder / "launch/range_world.launch", {"world": "bumper", "gui": "false"}
    plan = read_launch(file, packages=packages, report=Diagnostics(), arguments=arguments)

    assert [node.name for node in plan.nodes] == ["gazebo"]
    assert plan.nodes[0].arguments.endswith("gazebo_plugins/test/test_worlds/bumper.world")
