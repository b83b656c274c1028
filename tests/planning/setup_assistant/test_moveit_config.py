"""A package made of a URDF is read again by Trundle, and by launch files, without a finding."""

import os
from pathlib import Path
from typing import Any

import pytest
import yaml
from bench.arm_goals import ArmCase, run_goals
from tests.planning.arms import FOLDER, arm

from trundle.app.cli import main
from trundle.base.diagnostics import Diagnostics, UsageError
from trundle.gazebo.check.check_file import check
from trundle.planning.kinematics import read_kinematics
from trundle.planning.robot_model import RobotModel, robot_model
from trundle.planning.setup_assistant import DescriptionSource, moveit_config, write_moveit_config

_PATIENCE_S = 900.0
_LAUNCH = ("demo", "demo_gazebo", "gazebo", "move_group", "moveit_planning_execution", "planning_context")


def _package(name: str, **replaced: str) -> dict[str, str]:
    text = (FOLDER / f"{name}.urdf").read_text()
    for old, new in replaced.items():
        text = text.replace(old, new)
    report = Diagnostics()
    source = DescriptionSource(robot=robot_model(text).urdf, text=text)
    texts = moveit_config(source, "own_moveit_config", report=report, trials=50)
    assert report.findings == []
    return texts


def _model(texts: dict[str, str], name: str) -> RobotModel:
    report = Diagnostics()
    limits: Any = yaml.safe_load(texts["config/joint_limits.yaml"])
    model = robot_model((FOLDER / f"{name}.urdf").read_text(), texts[f"config/{name}.srdf"], limits, report)
    assert report.findings == []
    return model


def test_the_srdf_has_groups_states_and_an_end_effector() -> None:
    model = _model(_package("six_axis"), "six_axis")
    written = arm("six_axis")

    assert list(model.groups) == ["arm", "gripper"]
    assert model.group("arm").variables == written.group("arm").variables
    assert model.group("arm").tips == ("tool0",)
    assert model.group("gripper").links == written.group("gripper").links
    assert model.group("arm").default_states == {"home": dict.fromkeys(model.group("arm").variables, 0.0)}
    assert model.group("gripper").default_states == written.group("gripper").default_states
    assert model.end_effectors == written.end_effectors
    assert model.model_frame == "base_link"


def test_yaml_files_agree_with_the_groups() -> None:
    texts = _package("six_axis")
    files: dict[str, Any] = {
        Path(path).stem: yaml.safe_load(text) for path, text in texts.items() if path.endswith(".yaml")
    }
    joints = list(arm("six_axis").group("arm").joints)

    report = Diagnostics()
    assert list(read_kinematics(files["kinematics"], {"arm": None}, report)) == ["arm"]
    assert report.findings == []
    assert files["joint_limits"]["joint_limits"]["joint_4"]["max_velocity"] == 3.0
    assert "right_finger_joint" not in files["joint_limits"]["joint_limits"]  # it follows the other
    fake = [entry["joints"] for entry in files["fake_controllers"]["controller_list"]]
    assert fake == [joints, ["left_finger_joint"]]
    assert files["fake_controllers"]["initial"][0] == {"group": "arm", "pose": "home"}
    simple = files["simple_moveit_controllers"]["controller_list"][0]
    assert (simple["name"], simple["action_ns"]) == ("arm_controller", "follow_joint_trajectory")
    assert files["ros_controllers"]["arm_controller"]["type"] == "position_controllers/JointTrajectoryController"
    assert files["ompl_planning"]["arm"]["default_planner_config"] == "RRTConnect"
    assert set(files["ompl_planning"]["arm"]["planner_configs"]) == set(files["ompl_planning"]["planner_configs"])


def test_joints_with_effort_interfaces_have_gains() -> None:
    interface = "hardware_interface/EffortJointInterface"
    transmission = f"<joint name='joint_1'><hardwareInterface>{interface}</hardwareInterface></joint>"
    texts = _package("seven_axis", **{"</robot>": f"<transmission name='t'>{transmission}</transmission></robot>"})
    values: Any = yaml.safe_load(texts["config/ros_controllers.yaml"])

    assert values["arm_controller"]["type"] == "effort_controllers/JointTrajectoryController"
    assert values["arm_controller"]["gains"]["joint_1"]["p"] == 100


def test_a_robot_on_wheels_moves_in_a_plane() -> None:
    wheels = "".join(
        f"""<link name='wheel_{side}'/><joint name='wheel_{side}_joint' type='continuous'><parent link='base_link'/>
        <child link='wheel_{side}'/><axis xyz='0 1 0'/></joint>"""
        for side in ("left", "right")
    )
    srdf = _package("seven_axis", **{"</robot>": f"{wheels}</robot>"})["config/seven_axis.srdf"]

    assert 'name="world_joint" type="planar" parent_frame="odom" child_link="base_link"' in srdf
    assert '<passive_joint name="wheel_left_joint"/>' in srdf


def test_names_that_launch_files_cannot_hold_are_refused() -> None:
    with pytest.raises(UsageError, match=r"cannot be in a launch file, whose \$"):
        _package("seven_axis", base_link="$(env HOME)")
    source = DescriptionSource(robot=robot_model("<robot name='r'><link name='l'/></robot>").urdf, text="<robot/>")
    with pytest.raises(UsageError, match="'r' has no arm, a chain of three or more joints; joints that move: none"):
        moveit_config(source, "p", report=Diagnostics())


def test_a_name_is_a_file_in_the_package() -> None:
    texts = _package("seven_axis", **{'name="seven_axis"': 'name="../../seven &lt;axis&gt;"'})

    assert "config/robot_______seven__axis_.srdf" in texts
    assert "seven &lt;axis&gt;" in texts["package.xml"]


def test_nothing_is_overwritten(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="exists; nothing is written"):
        write_moveit_config({"a": "b"}, tmp_path)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path / "own"
    folder.mkdir()
    monkeypatch.chdir(folder)
    monkeypatch.delenv("ROS_PACKAGE_PATH", raising=False)
    return folder


def _launch_warnings(package: Path, name: str) -> list[str]:
    result = check(str(package / "launch" / f"{name}.launch"), dict(os.environ), start=Path.cwd())
    assert result.report.errors == []
    return result.report.warnings


@pytest.mark.parametrize("urdf", [str(FOLDER / "six_axis.urdf"), "package://arm_control/urdf/arm.urdf.xacro"])
def test_launch_files_of_a_made_package_have_no_warnings(
    urdf: str, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["new", "moveit_config", "own_moveit_config", "--urdf", urdf]) == 0
    printed = capsys.readouterr()

    assert printed.err == ""
    assert "Created file own_moveit_config/launch/demo.launch" in printed.out
    package = folder / "own_moveit_config"
    assert (package / "config" / "six_axis.urdf").is_file() == ("://" not in urdf)
    for name in _LAUNCH:
        assert _launch_warnings(package, name) == []


@pytest.mark.slow
@pytest.mark.parametrize("name", ["six_axis", "seven_axis", "scara"])
def test_an_arm_plans_and_moves_by_its_made_package(name: str, folder: Path) -> None:
    """The whole path: a URDF, its package, move_group, random goals executed by fake controllers."""
    assert main(["new", "moveit_config", "own_moveit_config", "--urdf", str(FOLDER / f"{name}.urdf")]) == 0
    demo = folder / "own_moveit_config" / "launch" / "demo.launch"

    words = f"{demo} use_rviz:=false"
    found = run_goals(ArmCase(launch=(words,), group="arm"), 15, folder, limit_s=_PATIENCE_S)

    assert (found.goals, found.executed, found.faults) == (15, 15, ())


def test_faulty_commands_write_nothing(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    for words, fault in (
        (["own", "--urdf", "no.urdf"], "no.urdf"),
        (["own"], "a moveit_config needs --urdf FILE; nothing else takes it"),
        (["own-config", "--urdf", "no.urdf"], "'own-config' is not a name"),
        (["own", "--urdf", "empty.world"], "empty.world is no URDF; MoveIt plans for robots in URDF"),
    ):
        assert main(["new", "moveit_config", *words]) != 0
        assert fault in capsys.readouterr().err
    assert main(["new", "world", "yard", "--urdf", "a.urdf"]) != 0
    assert list(folder.iterdir()) == []
