"""The launch files of gazebo_ros that Trundle ships ask for what the originals ask for."""

from pathlib import Path

import pytest

from trundle.diagnostics import Diagnostics
from trundle.launch import LaunchPlan, read_launch
from trundle.packages import Packages

_LOUD = {"paused": "true", "recording": "true", "verbose": "true", "physics": "bullet", "world_name": "/w.world"}
_ODD = {"gui": "false", "use_sim_time": "false", "debug": "true", "use_clock_frequency": "true"}


def asked(plan: LaunchPlan) -> tuple[object, ...]:
    nodes = [(n.full_name, n.package, n.type, n.arguments.split(), n.output, n.required) for n in plan.nodes]
    return nodes, {param.name: param.value for param in plan.params}


@pytest.mark.parametrize(
    "arguments",
    [{}, _LOUD, _ODD, {"gui_required": "true"}],
)
def test_an_empty_world_asks_for_the_same(shared: Path, arguments: dict[str, str]) -> None:
    originals = shared / "corpus/repos/ros-simulation+gazebo_ros_pkgs"
    ours = Packages({}, start=Path("/nonexistent")).find_package("gazebo_ros")
    theirs = Packages({"ROS_PACKAGE_PATH": str(originals)}, start=originals).find_package("gazebo_ros")
    assert ours is not None
    assert theirs is not None
    assert theirs.is_relative_to(originals)

    def read(folder: Path) -> tuple[object, ...]:
        file = folder / "launch/empty_world.launch"
        packages = Packages({}, start=folder)
        return asked(read_launch(file, packages=packages, report=Diagnostics(), arguments=arguments))

    assert read(ours) == read(theirs)


@pytest.mark.parametrize("name", ["shapes", "mud", "rubble", "willowgarage", "elevator", "range"])
def test_its_siblings_include_it_with_another_world(name: str) -> None:
    packages = Packages({}, start=Path("/nonexistent"))
    folder = packages.find_package("gazebo_ros")
    assert folder is not None
    plan = read_launch(folder / f"launch/{name}_world.launch", packages=packages, report=Diagnostics())

    assert plan.nodes[0].arguments.endswith(f" worlds/{name}.world")
