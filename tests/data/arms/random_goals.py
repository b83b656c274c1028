#!/usr/bin/env python3
"""Plan to random goals of a group and execute the plans; prints figures as JSON: random_goals.py GROUP NUMBER."""

import json
import sys

from moveit_msgs.msg import RobotState
from moveit_msgs.srv import GetStateValidity

import moveit_commander
import rospy

GROUP, GOALS = sys.argv[1], int(sys.argv[2])


def main(group, goals):
    moveit_commander.roscpp_initialize(sys.argv)
    rospy.init_node("arm_goals", anonymous=True)
    robot = moveit_commander.RobotCommander()
    names = [name for name in robot.get_group_names() if robot._r._robot.model.groups[name].is_chain]
    names = [name for name in names if len(robot.get_active_joint_names(name)) > 2] or robot.get_group_names()
    arm = moveit_commander.MoveGroupCommander(group or names[0], wait_for_servers=60)
    arm.set_max_velocity_scaling_factor(1.0)
    arm.set_max_acceleration_scaling_factor(1.0)
    arm.set_planning_time(10.0)
    rospy.wait_for_service("check_state_validity")
    service = rospy.ServiceProxy("check_state_validity", GetStateValidity)
    model = robot._r._robot.model
    joints = arm.get_active_joints()
    indices = model.indices(joints)

    def is_valid(values):
        state = RobotState()
        state.joint_state.name, state.joint_state.position = joints, list(map(float, values))
        state.is_diff = True
        return bool(service(robot_state=state, group_name=arm.get_name()).valid)

    figures = {"group": arm.get_name(), "joints": len(joints)}
    figures |= dict.fromkeys(("goals", "planned", "executed", "collisions", "beyond_limits"), 0)
    times = []
    tried = 0
    while figures["goals"] < goals and tried < 50 * goals:
        tried += 1
        values = robot._r._robot.random_positions(model.groups[arm.get_name()], model.default_positions())[indices]
        if not is_valid(values):
            continue
        figures["goals"] += 1
        arm.set_joint_value_target(dict(zip(joints, map(float, values), strict=True)))
        is_found, plan, seconds, _ = arm.plan()
        times.append(seconds)
        if not is_found:
            continue
        figures["planned"] += 1
        points = plan.joint_trajectory.points
        for point in points:
            speeds = [abs(v) for v in point.velocities]
            figures["beyond_limits"] += any(
                v > m * 1.01 for v, m in zip(speeds, model.max_velocity[indices], strict=False)
            )
        path = [p.positions for p in points[:: max(1, len(points) // 20)]]
        figures["collisions"] += not all(map(is_valid, path))
        figures["executed"] += bool(arm.execute(plan, wait=True))
    times.sort()
    figures["median_s"] = round(times[len(times) // 2], 3) if times else None
    figures["max_s"] = round(times[-1], 3) if times else None
    figures["tried"] = tried
    print(json.dumps(figures), flush=True)
    rospy.signal_shutdown("done")


if __name__ == "__main__":
    main(GROUP, GOALS)
