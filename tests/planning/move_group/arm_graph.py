"""move_group on a graph, for the six-axis arm of tests/data/arms, with fake controllers."""

from typing import Any

from tests.planning.arms import FOLDER

from trundle.ros import Message

ARM = [f"joint_{number}" for number in range(1, 7)]
_LIMITS = {name: {"has_acceleration_limits": True, "max_acceleration": 20.0} for name in ARM}
_FINGERS = ["left_finger_joint", "right_finger_joint"]


def start_arm(
    graph: Any,
    *,
    kind: str = "interpolate",
    name: str = "move_group",
    zeros: Any = None,
    cartesian_limits: Any = None,
    replaced: tuple[str, str] = ("", ""),
    srdf: str = "",
    **own: Any,
) -> None:
    """Start move_group and the nodes beside it; the arm is at `home`, its hand open.

    Args:
        graph: the graph.
        kind: type of the fake controllers.
        name: name of move_group.
        zeros: positions that joint_state_publisher has at first.
        cartesian_limits: of pilz' planners.
        replaced: text of the URDF, and what is there instead.
        srdf: text in place of the arm's SRDF.
        own: more parameters of move_group.
    """
    limits = {**_LIMITS, **{finger: {"has_acceleration_limits": True, "max_acceleration": 5.0} for finger in _FINGERS}}
    controllers = [
        {"name": "fake_arm_controller", "type": kind, "joints": ARM},
        {"name": "fake_gripper_controller", "type": kind, "joints": ["left_finger_joint"]},
    ]
    settings = {
        "planning_plugin": "ompl_interface/OMPLPlanner",
        "moveit_controller_manager": "moveit_fake_controller_manager/MoveItFakeControllerManager",
        "controller_list": controllers,
        "fake_interpolating_controller_rate": 50.0,
        "initial": [{"group": "arm", "pose": "home"}, {"group": "gripper", "pose": "open"}],
        **own,
    }
    graph.set_params(
        {
            "/robot_description": (FOLDER / "six_axis.urdf").read_text().replace(*replaced),
            "/robot_description_semantic": srdf or (FOLDER / "six_axis.srdf").read_text(),
            "/robot_description_planning": {"joint_limits": limits, "cartesian_limits": cartesian_limits or {}},
            f"/{name}": settings,
            "/joint_state_publisher": {
                "rate": 100,
                "source_list": [f"/{name}/fake_controller_joint_states"],
                "zeros": zeros or {},
            },
        }
    )
    graph.start("joint_state_publisher/joint_state_publisher")
    states = graph.listen("/joint_states", "sensor_msgs/JointState")
    graph.start("moveit_ros_move_group/move_group", name=name)
    graph.until(lambda: states and dict(zip(states[-1].name, states[-1].position, strict=True))["joint_5"] == 0.8)


def send(graph: Any, action: str, kind: str, goal: dict[str, Any]) -> Message:
    """Send a goal of an action; return its last message of the topic `result`."""
    results = graph.listen(f"/{action}/result", f"{kind}ActionResult")
    goals = graph.advertise(f"/{action}/goal", f"{kind}ActionGoal")
    graph.until(lambda: graph.connected(f"/{action}/result"))
    goals.publish({"goal": goal})
    graph.until(lambda: results)
    return results[0]


def joint_goal(positions: dict[str, float], tolerance: float = 1e-3) -> dict[str, Any]:
    """Return moveit_msgs/Constraints for joints."""
    return {
        "joint_constraints": [
            {
                "joint_name": name,
                "position": value,
                "tolerance_above": tolerance,
                "tolerance_below": tolerance,
                "weight": 1.0,
            }
            for name, value in positions.items()
        ]
    }


def request(goal: dict[str, Any], group: str = "arm") -> dict[str, Any]:
    """Return a moveit_msgs/MotionPlanRequest from the present state."""
    return {
        "group_name": group,
        "goal_constraints": [goal],
        "start_state": {"is_diff": True},
        "allowed_planning_time": 5.0,
        "max_velocity_scaling_factor": 1.0,
        "max_acceleration_scaling_factor": 1.0,
    }


def box(name: str, x: float, y: float, z: float, size: tuple[float, float, float]) -> dict[str, Any]:
    """Return a moveit_msgs/CollisionObject in the base's frame."""
    return {
        "header": {"frame_id": "base_link"},
        "id": name,
        "pose": {"position": {"x": x, "y": y, "z": z}, "orientation": {"w": 1.0}},
        "primitives": [{"type": 1, "dimensions": list(size)}],
        "primitive_poses": [{"orientation": {"w": 1.0}}],
    }


def add(graph: Any, *objects: dict[str, Any], **fields: Any) -> None:
    """Apply a diff with objects of the world."""
    scene = {"is_diff": True, "robot_state": {"is_diff": True}, "world": {"collision_objects": list(objects)}, **fields}
    assert graph.call("/apply_planning_scene", "moveit_msgs/ApplyPlanningScene", scene=scene).success
