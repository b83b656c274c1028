"""move_group warns of joints that are in no joint state."""

from typing import Any

from tests.planning.arms import FOLDER
from tests.planning.move_group.arm_graph import ARM, joint_goal, request

_PLAN = "moveit_msgs/GetMotionPlan"


def test_joints_that_were_never_reported_are_named_once(graph: Any) -> None:
    """A plan from the present state takes their defaults, which a robot may not have."""
    graph.set_params(
        {
            "/robot_description": (FOLDER / "six_axis.urdf").read_text(),
            "/robot_description_semantic": (FOLDER / "six_axis.srdf").read_text(),
            "/move_group": {"planning_plugin": "ompl_interface/OMPLPlanner"},
        }
    )
    lines = graph.listen("/rosout_agg", "rosgraph_msgs/Log")
    graph.start("moveit_ros_move_group/move_group", name="move_group")
    states = graph.advertise("/joint_states", "sensor_msgs/JointState")
    states.publish({"name": ARM[:-1], "position": [0.0] * 5})
    wanted = request(joint_goal({"joint_1": 0.3}))

    for _ in range(2):
        assert graph.call("/plan_kinematic_path", _PLAN, motion_plan_request=wanted).motion_plan_response.error_code.val

    warned = [line.msg for line in lines if "complete state" in line.msg]
    assert warned == ["The complete state of the robot is not yet known.  Missing joint_6, left_finger_joint"]
