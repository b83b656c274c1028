"""Messages of published packages that are not installed."""

import subprocess
import sys
from pathlib import Path

import pytest

from trundle.ros import Messages
from trundle.ros.messages import definition_search
from trundle.ros.rospy.environment import with_finder

_PACKAGES = sorted(path.stem for path in definition_search._PUBLISHED.glob("*.txt"))


@pytest.fixture(scope="module")
def messages(tmp_path_factory: pytest.TempPathFactory) -> Messages:
    messages = Messages()
    messages._definitions._on_path = {}
    return messages


@pytest.mark.parametrize("package", _PACKAGES)
def test_every_published_definition_has_its_dependencies(messages: Messages, package: str) -> None:
    for kind, name, _ in definition_search.published_definitions(package):
        assert name.startswith(f"{package}/")
        if kind == "srv":
            assert len(messages.service(name).md5sum) == 32
        else:
            assert len(messages.md5(name if kind == "msg" else f"{name}Action")) == 32


@pytest.mark.parametrize(
    ("type_name", "md5sum"),
    [
        ("dynamixel_msgs/JointState", "2b8449320cde76616338e2539db27c32"),
        ("geographic_msgs/GeoPoint", "c48027a852aeff972be80478ff38e81a"),
        ("industrial_msgs/RobotStatus", "b733cb45a38101840b75c4c0d6093d19"),
        ("moveit_msgs/PlanningScene", "acfc50bcfd6c7b978066bfa7c786002c"),
        ("octomap_msgs/Octomap", "9a45536b45c5e409cd49f04bb2d9999f"),
        ("uuid_msgs/UniqueID", "fec2a93b6f5367ee8112c9c0b41ff310"),
        ("velodyne_msgs/VelodyneScan", "50804fc9533a0e579e6322c04ae70566"),
    ],
)
def test_md5_sums_match_the_released_packages(messages: Messages, type_name: str, md5sum: str) -> None:
    assert messages.md5(type_name) == md5sum


def test_a_package_on_the_path_is_preferred(tmp_path: Path) -> None:
    """The package on the path may be of another release."""
    (tmp_path / "robotnik_msgs/msg").mkdir(parents=True)
    (tmp_path / "robotnik_msgs/package.xml").write_text("<package><name>robotnik_msgs</name></package>")
    (tmp_path / "robotnik_msgs/msg/State.msg").write_text("int8 mine\n")
    messages = Messages()
    messages._definitions._on_path = {"robotnik_msgs": tmp_path / "robotnik_msgs"}

    assert messages.fields("robotnik_msgs/State") == {"mine": "int8"}
    code = "import robotnik_msgs.msg as m; print(m.State(mine=1), [n for n in dir(m) if n[0].isupper()])"
    assert _printed(code, ROS_PACKAGE_PATH=str(tmp_path)) == "mine: 1 ['State']"


def test_a_package_on_the_path_without_definitions_hides_none(tmp_path: Path) -> None:
    messages = Messages()
    messages._definitions._on_path = {"costmap_2d": tmp_path}

    assert messages.fields("costmap_2d/VoxelGrid")["size_x"] == "uint32"


def test_programs_import_published_messages() -> None:
    code = "from moveit_msgs.msg import MoveGroupAction; from mavros_msgs.srv import SetMode; print(SetMode._type)"
    assert _printed(code) == "mavros_msgs/SetMode"


def _printed(code: str, **variables: str) -> str:
    done = subprocess.run(
        [sys.executable, "-c", code], env=with_finder(variables), capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()
