#!/usr/bin/env python3
"""Sends random valid goals to move_group, by turns of joints and of a pose, and judges each plan and motion.

Parameters: ~group, ~goals (number), ~out (file of the result), ~tolerance [rad] or [m] of where a motion ends,
~planning_time [s], ~floor: height of the ground below the robot, in its frame [m],
~bounds: joint → bounds of its goals, ~after: node that moves the arm first.
"""

import json
import os
import sys
import time
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from geometry_msgs.msg import PoseStamped  # pyright: ignore[reportMissingImports]
from moveit_msgs.msg import RobotState  # pyright: ignore[reportMissingImports]
from moveit_msgs.srv import GetPositionFK, GetStateValidity  # pyright: ignore[reportMissingImports]
from sensor_msgs.msg import JointState  # pyright: ignore[reportMissingImports]

import moveit_commander
import rosnode
import rospy
from trundle.base.diagnostics import Diagnostics
from trundle.planning.planning_scene import CollisionObject, PlacedShape, PlanningScene
from trundle.planning.robot_model import robot_model
from trundle.robots.model import Box
from trundle.robots.packages import Packages
from trundle.spatial import Pose

_SLACK = 1e-3
"""Over a limit, as a share of it."""
_FLOOR = (4.0, 4.0, 0.1)
"""Size of the ground [m]."""
_TRIES = 500
_MOTION_S = 6.0
"""Duration of the motion that the node before has sent [s]."""
_LOOKS, _LOOK_S = 1000, 0.01
_STILL_LOOKS, _STILL = 50, 1e-4
"""Number of looks, without a greater change of a joint [rad] or [m], after which an arm stands."""
_STEP = 0.02
"""Greatest motion of a joint between two states that are checked [rad] or [m]."""


class Judge:
    """One group of a robot with what move_group says of it."""

    def __init__(self) -> None:
        self.name: str = rospy.get_param("~group")
        self.robot: Any = moveit_commander.RobotCommander()
        self.group: Any = moveit_commander.MoveGroupCommander(self.name, wait_for_servers=300)
        self.joints: list[str] = self.group.get_active_joints()
        rospy.wait_for_service("check_state_validity")
        name: Any = rospy.search_param("robot_description") or "/robot_description"
        texts: Any = [rospy.get_param(f"{name}{more}") for more in ("", "_semantic")]
        self._limits: Any = rospy.get_param(f"{name}_planning/joint_limits", {})
        model = robot_model(texts[0], texts[1], self._limits, Diagnostics())
        self._scene = PlanningScene(model, packages=Packages(dict(os.environ), start=Path.cwd()))
        self._validity: Any = rospy.ServiceProxy("check_state_validity", GetStateValidity, persistent=True)
        self._random = np.random.default_rng(1)
        self._recorded: list[tuple[list[str], list[float]]] | None = None
        self._newest = 0.0
        """Time of the last joint state [s]."""
        self._present: dict[str, float] = {}
        self._tolerance = float(rospy.get_param("~tolerance", 0.01))
        self._bounds: Any = rospy.get_param("~bounds", {})
        rospy.Subscriber("joint_states", JointState, self._on_states, queue_size=1000)
        self.group.set_max_velocity_scaling_factor(1.0)
        self.group.set_max_acceleration_scaling_factor(1.0)
        self._add_floor(rospy.get_param("~floor", ""))
        self.group.set_planning_time(float(rospy.get_param("~planning_time", 5.0)))

    def _add_floor(self, height: Any) -> None:
        """Put the ground into both scenes, a centimetre lower; nothing for ""."""
        if height == "":
            return
        z = float(height) - 0.01 - _FLOOR[2] / 2.0
        pose: Any = PoseStamped()
        pose.header.frame_id = self.group.get_planning_frame()
        pose.pose.position.z, pose.pose.orientation.w = z, 1.0
        world = moveit_commander.PlanningSceneInterface(synchronous=True)
        world.add_box("floor", pose, _FLOOR)
        self._scene.add(CollisionObject(name="floor", shapes=(PlacedShape(Box(_FLOOR)),), pose=Pose((0.0, 0.0, z))))

    def _on_states(self, message: Any) -> None:
        self._present.update(zip(message.name, message.position, strict=False))
        self._newest = message.header.stamp.to_sec()
        if self._recorded is not None:
            self._recorded.append((list(message.name), list(message.position)))

    def touching(self, names: Any, positions: Any) -> list[str]:
        """Return the pairs that touch in a state: of the robot alone, checked here."""
        state = self._scene.positions.copy()
        for name, value in zip(names, positions, strict=False):
            if name in self._scene.model.variables:
                state[self._scene.model.variable_index(name)] = value
        state = self._scene.model.with_mimics(state)
        if self._scene.is_free(state, group=self.name):
            return []
        return [f"{one.body_1}–{one.body_2}" for one in self._scene.check(state, group=self.name)]

    def contacts(self, names: Any, positions: Any) -> list[str]:
        """Return what touches in a state, as move_group says, or a word on limits."""
        state: Any = RobotState(is_diff=True)
        state.joint_state.name, state.joint_state.position = list(names), [float(value) for value in positions]
        answer = self._validity(state, self.name, None)
        if answer.valid:
            return []
        pairs = {f"{one.contact_body_1}–{one.contact_body_2}" for one in answer.contacts}
        return sorted(pairs) or ["limits or constraints"]

    def goal(self) -> list[float]:
        """Return a random state without collision."""
        for _ in range(_TRIES):
            values = self.group.get_random_joint_values()
            at = dict(zip(self.joints, values, strict=True))
            if not all(low <= at[name] <= high for name, (low, high) in self._bounds.items()):
                continue
            if not self.contacts(self.joints, values):
                return values
        raise RuntimeError(f"no valid state in {_TRIES} random ones")

    def faults_of_limits(self, trajectory: Any) -> list[str]:
        """Return the limits that a trajectory exceeds, and a word on times that do not increase."""
        faults: list[str] = []
        names, points = list(trajectory.joint_names), trajectory.points
        states = np.array([point.positions for point in points])
        times = np.array([point.time_from_start.to_sec() for point in points])
        if len(times) > 1 and not np.all(np.diff(times) > 0.0):
            faults.append("times do not increase")
        for column, name in enumerate(names):
            unlimited = self._turns(name) or name not in self.joints
            lower, upper = (-np.inf, np.inf) if unlimited else self.robot.get_joint(name).bounds()
            span = max(1e-6, lower - states[0, column], states[0, column] - upper)  # gravity pulled it out
            if states[:, column].min() < lower - span or states[:, column].max() > upper + span:
                faults.append(f"{name} leaves {lower:.3f} … {upper:.3f}")
            limit = self._limits.get(name, {})
            for what, has, field in (
                ("max_velocity", "has_velocity_limits", "velocities"),
                ("max_acceleration", "has_acceleration_limits", "accelerations"),
            ):
                if not limit.get(has) or not getattr(points[0], field):
                    continue
                most = max(abs(getattr(point, field)[column]) for point in points)
                if most > limit[what] * (1.0 + _SLACK):
                    faults.append(f"{name}: {what} {most:.3f} > {limit[what]}")
        return faults

    def contacts_of_plan(self, trajectory: Any) -> list[str]:
        """Return the first contact of a trajectory, also between its points."""
        names, states = list(trajectory.joint_names), np.array([point.positions for point in trajectory.points])
        for before, after in pairwise(states):
            count = max(1, int(np.ceil(np.abs(after - before).max() / _STEP)))
            for share in np.arange(count) / count:
                touched = self.touching(names, before + share * (after - before))
                if touched:
                    return [f"touches {', '.join(touched)}"]
        return []

    def _turns(self, name: str) -> bool:
        """True for a joint that turns without end."""
        model = self._scene.model
        return not model.is_bounded[model.variable_index(name)] and model.joint(name).type == "continuous"

    def _distance(self, name: str, a: float, b: float) -> float:
        """Return how far two positions of a joint are apart [rad] or [m]."""
        return abs(float(np.remainder(a - b + np.pi, 2.0 * np.pi) - np.pi)) if self._turns(name) else abs(a - b)

    def keep_state(self) -> None:
        """Take over the present positions of what the group does not move."""
        present = self.robot.get_current_state().joint_state
        for name, value in zip(present.name, present.position, strict=False):
            self._scene.positions[self._scene.model.variable_index(name)] = value

    def run(self, number: int) -> dict[str, Any]:
        """Judge one goal."""
        self.keep_state()
        values = self.goal()
        is_pose = number % 2 == 1 and bool(self.group.get_end_effector_link())
        kind = "pose" if is_pose else "joints"
        self.group.set_start_state_to_current_state()
        if is_pose:
            self.group.set_joint_value_target(values)
            link = self.group.get_end_effector_link()
            poses = self._poses(link, values)
            self.group.clear_pose_targets()
            self.group.set_pose_target(poses)
        else:
            self.group.set_joint_value_target(values)
        began = rospy.get_time()
        is_planned, plan, seconds, code = self.group.plan()
        if not is_planned:
            return {"kind": kind, "fault": f"no plan ({code.val})", "values": values, "s": seconds}
        trajectory = plan.joint_trajectory
        limits, contacts = self.faults_of_limits(trajectory), self.contacts_of_plan(trajectory)
        faults = [*limits, *contacts]
        self._recorded = []
        is_executed = self.group.execute(plan, wait=True)
        ended = rospy.get_time()
        self._wait_still(ended)
        recorded, self._recorded = self._recorded, None
        result: dict[str, Any] = {"kind": kind, "s": seconds, "moved_s": ended - began, "planned": True}
        if not is_executed:
            faults.append("not executed")
        at = dict(self._present)
        last = dict(zip(trajectory.joint_names, trajectory.points[-1].positions, strict=True))
        errors: dict[str, float] = {name: self._distance(name, at[name], value) for name, value in last.items()}
        worst = max(errors, key=lambda name: errors[name])
        if errors[worst] > self._tolerance:
            faults.append(f"{worst} ends {errors[worst]:.4f} off")
        touched: dict[str, bool] = {}
        for names, positions in recorded:
            for pair in self.touching(names, positions):
                touched[pair] = True
        if touched:
            faults.append(f"on the way: {', '.join(touched)}")
            contacts.extend(touched)
        result |= {"states": len(recorded), "limits": limits, "contacts": contacts}
        return {**result, "fault": "; ".join(faults)} if faults else result

    def _wait_still(self, since: float) -> None:
        """Wait until the arm stands after a time [s]: a busy machine hands on joint states late."""
        before: dict[str, float] = {}
        looks = 0
        for _ in range(_LOOKS):
            now = dict(self._present)
            moves = before.keys() != now.keys() or any(abs(now[name] - before[name]) > _STILL for name in now)
            looks = 0 if moves or self._newest < since else looks + 1
            if looks >= _STILL_LOOKS:
                return
            before = now if moves else before
            time.sleep(_LOOK_S)

    def _poses(self, link: str, values: list[float]) -> Any:
        forward: Any = rospy.ServiceProxy("compute_fk", GetPositionFK)
        state: Any = RobotState(is_diff=True)
        state.joint_state.name, state.joint_state.position = self.joints, values
        stamped: Any = PoseStamped()
        header = stamped.header
        header.frame_id = self.group.get_planning_frame()
        return forward(header, [link], state).pose_stamped[0]


def wait_for_end(node: Any) -> None:
    """Wait until a node has ended, and the arm has done what it said; nothing for ""."""
    if not node:
        return
    while node in rosnode.get_node_names():
        rospy.sleep(0.5)
    rospy.sleep(_MOTION_S)


def main() -> int:
    """Send the goals, and write the result."""
    moveit_commander.roscpp_initialize(sys.argv)
    rospy.init_node("judge_arm")
    out: str = rospy.get_param("~out")
    rows: list[dict[str, Any]] = []
    error = ""
    try:
        judge = Judge()
        wait_for_end(rospy.get_param("~after", ""))
        for number in range(int(rospy.get_param("~goals", 50))):
            rows.append(judge.run(number))
            rospy.loginfo("goal %d: %s", number, rows[-1])
    except Exception as fault:
        error = f"{type(fault).__name__}: {fault}"
        rospy.logerr("judge: %s", error)
    with open(out, "w") as file:
        json.dump({"rows": rows, "error": error}, file)
    return 0


sys.exit(main())
