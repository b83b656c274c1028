"""moveit_commander: what programs write, on a graph with move_group."""

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

from tests.planning.move_group.arm_graph import start_arm

import trundle

_SITE = Path(trundle.__file__).parent / "ros/rospy/site"
_BEGIN = """
import sys
import genpy, rospy, moveit_commander
from geometry_msgs.msg import Pose, PoseStamped
from moveit_msgs.msg import RobotState
from moveit_commander.conversions import list_to_pose, pose_to_list
moveit_commander.roscpp_initialize(sys.argv)
rospy.init_node("program")
arm = moveit_commander.MoveGroupCommander("arm", wait_for_servers=30)
arm.set_max_velocity_scaling_factor(1.0)
arm.set_max_acceleration_scaling_factor(1.0)
robot = moveit_commander.RobotCommander()
scene = moveit_commander.PlanningSceneInterface()
"""


def _run(graph: Any, folder: Path, text: str, *, begin: str = _BEGIN) -> str:
    """Run a program on the graph; return what it printed itself."""
    program = folder / "program.py"
    program.write_text(begin + text)
    environment = {**os.environ, "ROS_MASTER_URI": graph.uri, "PYTHONPATH": str(_SITE), "ROS_HOME": str(folder)}
    done = subprocess.run(
        [sys.executable, str(program)], env=environment, capture_output=True, text=True, check=False, timeout=120
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return "".join(line for line in done.stdout.splitlines(True) if not line.startswith("[INFO]"))


def test_a_program_plans_moves_and_asks(graph: Any, tmp_path: Path) -> None:
    start_arm(graph, kind="last point")

    printed = _run(
        graph,
        tmp_path,
        """
assert robot.get_group_names() == ["arm", "gripper", "arm_with_gripper"], robot.get_group_names()
assert arm.get_end_effector_link() == "tool0" and arm.get_planning_frame() == "base_link"
assert arm.get_named_targets() == ["home"]
assert [round(v, 3) for v in arm.get_current_joint_values()] == [0, 0, 0, 0, 0.8, 0]
success, plan, seconds, code = arm.plan([0.4, 0.2, -0.3, 0.0, 0.6, 0.1])
assert success and code.val == 1 and seconds > 0 and plan.joint_trajectory.points
assert arm.execute(plan, wait=True)
start = arm.get_current_pose().pose
lower = list_to_pose(pose_to_list(start)); lower.position.z -= 0.05
path, fraction = arm.compute_cartesian_path([lower], 0.01, 0.0)
assert fraction == 1.0 and arm.execute(path)
assert abs(arm.get_current_pose().pose.position.z - lower.position.z) < 1e-3
arm.set_pose_target(start)
assert arm.go(wait=True)
arm.clear_pose_targets()
assert arm.go("home")
slow = arm.retime_trajectory(robot.get_current_state(), path, 0.1, 0.1)
assert slow.joint_trajectory.points[-1].time_from_start > path.joint_trajectory.points[-1].time_from_start
assert not arm.retime_trajectory(robot.get_current_state(), path, 0.1, 0.1, algorithm="").joint_trajectory.points
state = robot.get_current_state()
assert state.multi_dof_joint_state.header.frame_id == "base_link" and not state.joint_state.header.stamp.to_sec()
try:
    arm.enforce_bounds(RobotState())
except genpy.DeserializationError:
    pass
else:
    raise AssertionError("bounds of an empty state")
assert scene._apply_planning_scene_diff.resolved_name == "/apply_planning_scene"
assert arm.get_jacobian_matrix(arm.get_current_joint_values()).shape == (6, 6)
assert robot.get_joint("joint_2").bounds() == [-1.9, 2.1]
assert robot.joint_5.move(0.5) and abs(robot.get_joint("joint_5").value() - 0.5) < 1e-3
hand = robot.gripper
assert hand.go("closed") and max(hand.get_current_joint_values()) < 1e-3, hand.get_current_joint_values()
assert robot.get_link("tool0").pose().header.frame_id == "base_link"
assert len(robot.get_robot_markers().markers) >= 9
print("all is well")
""",
    )

    assert printed.endswith("all is well\n")


def test_a_program_names_itself_after_its_objects(graph: Any, tmp_path: Path) -> None:
    """MoveIt's C++ is a node beside rospy's, so programs ask for the scene before they call rospy.init_node."""
    start_arm(graph, kind="last point")

    printed = _run(
        graph,
        tmp_path,
        """
import sys
sys.argv += ["__name:=late", "high:=low"]
import rosnode, rospy, moveit_commander
from moveit_commander import CollisionObject, Grasp, PlaceLocation, RobotState, conversions
scene = moveit_commander.PlanningSceneInterface()
robot = moveit_commander.RobotCommander()
assert rospy.get_name().startswith("/move_group_commander_wrappers_"), rospy.get_name()
rospy.init_node("program")
assert rospy.get_name() == "/late" and rospy.resolve_name("~a") == "/late/a" and rospy.resolve_name("high") == "/low"
assert len([name for name in rosnode.get_node_names() if name == "/late" or "wrappers" in name]) == 2
assert scene.get_known_object_names() == [] and robot.arm.get_current_joint_values()
print("both are there")
""",
        begin="",
    )

    assert printed == "both are there\n"


def test_objects_are_added_found_attached_and_removed(graph: Any, tmp_path: Path) -> None:
    start_arm(graph, kind="last point")
    mesh = tmp_path / "pyramid.stl"
    corners = ["0 0 0", "1 0 0", "0 1 0", "0 0 1"]
    faces = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]
    facets = "".join(
        "facet normal 0 0 1\nouter loop\n"
        + "".join(f"vertex {corners[index]}\n" for index in face)
        + "endloop\nendfacet\n"
        for face in faces
    )
    mesh.write_text(f"solid pyramid\n{facets}endsolid pyramid\n")

    printed = _run(
        graph,
        tmp_path,
        f"""
pose = PoseStamped(); pose.header.frame_id = "base_link"; pose.pose.orientation.w = 1; pose.pose.position.x = -0.6
scene.add_box("box", pose, (0.1, 0.2, 0.3))
scene.add_sphere("ball", pose, 0.1)
scene.add_cylinder("can", pose, 0.2, 0.05)
scene.add_plane("floor", pose)
scene.add_mesh("pyramid", pose, {str(mesh)!r}, (0.1, 0.1, 0.1))
assert sorted(scene.get_known_object_names()) == ["ball", "box", "can", "floor", "pyramid"]
objects = scene.get_objects(["box", "pyramid"])
assert list(objects["box"].primitives[0].dimensions) == [0.1, 0.2, 0.3]
assert len(objects["pyramid"].meshes[0].triangles) == 4
assert abs(max(v.x for v in objects["pyramid"].meshes[0].vertices) - 0.1) < 1e-6
assert scene.get_known_object_names_in_roi(-0.7, -0.1, -0.1, -0.5, 0.1, 0.1) != []
assert scene.get_object_poses(["box"])["box"].position.x == -0.6
scene.attach_object("ball", "tool0", ["hand"])
assert list(scene.get_attached_objects()) == ["ball"]
assert "ball" not in scene.get_known_object_names()
scene.remove_attached_object("tool0", "ball")
assert "ball" in scene.get_known_object_names()
scene.remove_world_object("box")
scene.clear()
assert scene.get_known_object_names() == []
print("all is well")
""",
    )

    assert printed.endswith("all is well\n")


def test_targets_that_do_not_fit_raise_the_originals_words(graph: Any, tmp_path: Path) -> None:
    start_arm(graph, kind="last point")

    printed = _run(
        graph,
        tmp_path,
        """
def words(act):
    try:
        act()
    except moveit_commander.MoveItCommanderException as error:
        print(error)
words(lambda: arm.set_joint_value_target([9.0] * 6))
words(lambda: arm.set_named_target("nowhere"))
words(lambda: arm.set_joint_value_target("joint_1"))
words(lambda: arm.set_max_velocity_scaling_factor(2.0))
words(lambda: arm.set_workspace([1.0]))
words(lambda: robot.get_group("leg"))
words(lambda: robot.get_joint("knee"))
words(lambda: robot.get_group("gripper").set_pose_target([0, 0, 0, 0, 0, 0]))
words(lambda: scene.add_mesh("mesh", PoseStamped(), "/no/such.stl"))
try:
    moveit_commander.MoveGroupCommander("leg")
except RuntimeError as error:
    print(error)
""",
    )

    assert printed.splitlines() == [
        "Error setting joint target. Is the target within bounds?",
        "Unable to set target nowhere. Is the target within bounds?",
        "Joint value expected when joint name specified",
        "Expected value in the range from 0 to 1 for scaling factor",
        "Expected 0, 4 or 6 values in list specifying workspace",
        "There is no group named leg",
        "There is no joint named knee",
        "There is no end effector to set the pose for",
        "/no/such.stl: No such file or directory",
        "Group 'leg' was not found.",
    ]


def test_a_plan_is_a_trajectory_on_older_graphs(graph: Any, tmp_path: Path) -> None:
    """Melodic's plan() returns the trajectory; Noetic's tuple answers as one as well."""
    start_arm(graph, kind="last point")
    text = """
plan = arm.plan([0.2, 0.1, -0.2, 0.0, 0.6, 0.0])
from moveit_msgs.msg import DisplayTrajectory
shown = DisplayTrajectory(); shown.trajectory.append(plan)
import io; shown.serialize(io.BytesIO())
print(type(plan).__name__, len(plan.joint_trajectory.points) > 1, arm.execute(plan))
"""

    noetic = _run(graph, tmp_path, text)
    graph.set_params({"/rosdistro": "melodic"})
    melodic = _run(graph, tmp_path, text.replace("[0.2,", "[-0.2,"))

    assert noetic.split() == ["PlanResult", "True", "True"]
    assert melodic.split()[1:] == ["True", "True"]
    assert "PlanResult" not in melodic


def test_commands_in_words_move_the_arm(graph: Any, tmp_path: Path) -> None:
    start_arm(graph, kind="last point")

    printed = _run(
        graph,
        tmp_path,
        """
shell = moveit_commander.MoveGroupCommandInterpreter()
for command in ("id", "use leg", "use arm", "which", "a = [0.1 0 0 0 0.7 0]", "a[1] = 0.2", "b = a", "b",
                "go b", "record here", "go up 0.02", "plan home", "execute", "tolerance 0.001", "eef", "fly"):
    level, text = shell.execute(command)
    print(level, text.splitlines()[-1] if text else "")
""",
    )

    answers = printed.splitlines()
    assert answers[0].startswith("4 ")
    assert answers[1] == "1 Initializing leg: Group 'leg' was not found."
    assert answers[3] == "4 arm"
    assert answers[7] == "4 [0.1 0.2 0.0 0.0 0.7 0.0]"
    assert answers[8] == "3 Moved to b"
    assert answers[10] == "3 Moved up by 0.02 m"
    assert answers[11:13] == ["3 Planned to home", "3 Plan submitted for execution"]
    assert answers[14] == "4 tool0"
    assert answers[15] == "2 Unknown command: 'fly'"


def test_modules_of_python_and_tf_come_with_moveit_commander(graph: Any, tmp_path: Path) -> None:
    """Programs of ROS by Example end with `moveit_commander.os._exit(0)`."""
    ends = "moveit_commander.os.write(1, b'moved'); moveit_commander.os._exit(0); print('never')"
    asks = "assert moveit_commander.tf.transformations and moveit_commander.time.time()"

    printed = _run(graph, tmp_path, f"{asks}\n{ends}", begin="import moveit_commander\n")

    assert printed == "moved"
