"""Constraints of messages, and how well a state satisfies them."""

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from msgspec.structs import replace

from trundle.planning.planners import (
    Constraints,
    JointConstraint,
    OrientationConstraint,
    PositionConstraint,
    VisibilityConstraint,
    is_visible,
)
from trundle.planning.planning_scene import PlacedShape
from trundle.robots.model import Box, Cone, Cylinder, Sphere
from trundle.spatial import Pose, Vector3, conjugate, quaternion_product, rpy_from_quaternion

from .scene import Frames, mesh_of, pose_of, primitive_of

if TYPE_CHECKING:
    from trundle.planning.kinematics import Kinematics
    from trundle.planning.planning_scene import PlanningScene
    from trundle.planning.robot_model import RobotModel
    from trundle.ros import Message

_AXES: tuple[Any, ...] = ("z", "y", "x")
"""Values of VisibilityConstraint.sensor_view_direction."""
_MAX_CONSTRAINTS = 1000
_MARGIN = 1e-6


def constraints_of(message: "Message", model: "RobotModel", frames: Frames) -> Constraints:
    """Read moveit_msgs/Constraints; frames of links stay, all others are replaced by the model's.

    Raises:
        ValueError: too many, or numbers that are not finite.
        FrameError: a frame is unknown.
    """
    parts = (
        message.joint_constraints,
        message.position_constraints,
        message.orientation_constraints,
        message.visibility_constraints,
    )
    if sum(map(len, parts)) > _MAX_CONSTRAINTS:
        raise ValueError(f"more than {_MAX_CONSTRAINTS} constraints")
    return Constraints(
        name=str(message.name),
        joints=tuple(
            JointConstraint(
                variable=str(one.joint_name),
                position=float(one.position),
                tolerance_above=float(one.tolerance_above),
                tolerance_below=float(one.tolerance_below),
            )
            for one in message.joint_constraints
        ),
        positions=tuple(_position(one, model, frames) for one in message.position_constraints),
        orientations=tuple(_orientation(one, model, frames) for one in message.orientation_constraints),
        visibilities=tuple(_visibility(one, model, frames) for one in message.visibility_constraints),
    )


def known_constraints(
    message: "Message", model: "RobotModel", frames: Frames, warn: Callable[[str], object]
) -> Constraints:
    """Read moveit_msgs/Constraints of paths or states: without those of links and joints that the robot lacks.

    MoveIt checks only what it can, and so do programs that rely on that: a constraint without a link is none.

    Args:
        message: the constraints.
        model: robot.
        frames: present ones.
        warn: called with a sentence for each constraint that is left out.

    Raises:
        ValueError: too many, or numbers that are not finite.
        FrameError: a frame is unknown.
    """
    constraints = constraints_of(message, model, frames)
    variables = frozenset(model.variables)
    for joint in constraints.joints:
        if joint.variable not in variables:
            warn(f"Joint '{joint.variable}' not found in model '{model.name}'. Constraint invalid.")
    for place in constraints.positions:
        if not model.has_link(place.link):
            warn(f"Position constraint link model {place.link} not found in kinematic model. Constraint invalid.")
    for turn in constraints.orientations:
        if not model.has_link(turn.link):
            warn(f"Could not find link model for link name '{turn.link}'. Constraint invalid.")
    return replace(
        constraints,
        joints=tuple(joint for joint in constraints.joints if joint.variable in variables),
        positions=tuple(place for place in constraints.positions if model.has_link(place.link)),
        orientations=tuple(turn for turn in constraints.orientations if model.has_link(turn.link)),
    )


def _frame(name: str, model: "RobotModel", frames: Frames) -> tuple[str, Pose]:
    """Return a link that moves and the identity, or the model's frame and the pose of a frame in it."""
    plain = name.lstrip("/")
    if plain != model.model_frame and model.has_link(plain):
        return plain, Pose()
    return "", frames.find(plain)


def _position(message: "Message", model: "RobotModel", frames: Frames) -> PositionConstraint:
    frame, pose = _frame(str(message.header.frame_id), model, frames)
    volume = message.constraint_region
    region = [
        PlacedShape(primitive_of(shape), pose @ pose_of(at))
        for shape, at in zip(volume.primitives, volume.primitive_poses, strict=False)
    ]
    region += [
        PlacedShape(mesh_of(shape), pose @ pose_of(at))
        for shape, at in zip(volume.meshes, volume.mesh_poses, strict=False)
    ]
    offset = message.target_point_offset
    return PositionConstraint(
        link=str(message.link_name), frame=frame, offset=(offset.x, offset.y, offset.z), region=tuple(region)
    )


def _orientation(message: "Message", model: "RobotModel", frames: Frames) -> OrientationConstraint:
    frame, pose = _frame(str(message.header.frame_id), model, frames)
    q = message.orientation
    norm = math.hypot(q.w, q.x, q.y, q.z)
    wanted = (q.w / norm, q.x / norm, q.y / norm, q.z / norm) if norm > 1e-6 else (1.0, 0.0, 0.0, 0.0)
    return OrientationConstraint(
        link=str(message.link_name),
        frame=frame,
        orientation=quaternion_product(pose.quaternion, wanted),
        tolerances=(
            float(message.absolute_x_axis_tolerance),
            float(message.absolute_y_axis_tolerance),
            float(message.absolute_z_axis_tolerance),
        ),
        parameterization="rotation_vector" if int(message.parameterization) == 1 else "xyz_euler_angles",
    )


def _visibility(message: "Message", model: "RobotModel", frames: Frames) -> VisibilityConstraint:
    target, target_pose = _frame(str(message.target_pose.header.frame_id), model, frames)
    sensor, sensor_pose = _frame(str(message.sensor_pose.header.frame_id), model, frames)
    return VisibilityConstraint(
        target_radius=float(message.target_radius),
        target_frame=target,
        target_pose=target_pose @ pose_of(message.target_pose.pose),
        cone_sides=int(message.cone_sides),
        sensor_frame=sensor,
        sensor_pose=sensor_pose @ pose_of(message.sensor_pose.pose),
        max_view_angle=float(message.max_view_angle),
        max_range_angle=float(message.max_range_angle),
        sensor_view_direction=_AXES[min(int(message.sensor_view_direction), 2)],
    )


def constraint_check(
    kinematics: "Kinematics",
    message: "Message",
    frames: Frames,
    scene: "PlanningScene | None",
    warn: Callable[[str], object],
) -> Callable[[np.ndarray], bool]:
    """Return a function that is True for states that satisfy moveit_msgs/Constraints; `scene` is asked for sight.

    What `known_constraints` leaves out is satisfied.

    Raises:
        ValueError: numbers that are not finite.
        FrameError: a frame is unknown.
    """
    constraints = known_constraints(message, kinematics.model, frames, warn)
    if constraints.is_empty:
        return lambda _: True
    return lambda positions: all(is_met for is_met, _ in _results(kinematics, constraints, positions, scene))


def evaluate(
    kinematics: "Kinematics",
    message: "Message",
    frames: Frames,
    positions: np.ndarray,
    scene: "PlanningScene",
    warn: Callable[[str], object],
) -> list[tuple[bool, float]]:
    """Return for each constraint whether a state satisfies it, and how far it is off; 0 for constraints of sight.

    Raises:
        ValueError: numbers that are not finite.
        FrameError: a frame is unknown.
    """
    return _results(kinematics, known_constraints(message, kinematics.model, frames, warn), positions, scene)


def _results(
    kinematics: "Kinematics", constraints: Constraints, positions: np.ndarray, scene: "PlanningScene | None"
) -> list[tuple[bool, float]]:
    model = kinematics.model
    results: list[tuple[bool, float]] = []
    for joint in constraints.joints:
        difference = float(positions[model.variable_index(joint.variable)]) - joint.position
        if model.has_joint(joint.variable) and model.joint(joint.variable).type == "continuous":
            difference = (difference + math.pi) % (2.0 * math.pi) - math.pi
        is_met = -joint.tolerance_below - _MARGIN <= difference <= joint.tolerance_above + _MARGIN
        results.append((is_met, abs(difference)))
    for place in constraints.positions:
        base = kinematics.link_pose(positions, place.frame) if place.frame else Pose()
        point = kinematics.link_pose(positions, place.link).transform_point(place.offset)
        distance = min((_outside(base @ shape.pose, shape.geometry, point) for shape in place.region), default=0.0)
        results.append((distance <= _MARGIN, distance))
    for turn in constraints.orientations:
        base = kinematics.link_pose(positions, turn.frame).quaternion if turn.frame else Pose().quaternion
        wanted = quaternion_product(base, turn.orientation)
        error = quaternion_product(conjugate(wanted), kinematics.link_pose(positions, turn.link).quaternion)
        angles = _rotation_vector(error) if turn.parameterization == "rotation_vector" else rpy_from_quaternion(error)
        is_met = all(abs(a) <= t + _MARGIN for a, t in zip(angles, turn.tolerances, strict=True))
        results.append((is_met, math.sqrt(sum(a * a for a in angles))))
    if scene is not None:
        results += [(is_visible(scene, sight, positions), 0.0) for sight in constraints.visibilities]
    return results


def _rotation_vector(q: tuple[float, float, float, float]) -> Vector3:
    w, x, y, z = q if q[0] >= 0.0 else (-q[0], -q[1], -q[2], -q[3])
    length = math.sqrt(x * x + y * y + z * z)
    factor = 2.0 * math.atan2(length, w) / length if length > 1e-9 else 2.0
    return (factor * x, factor * y, factor * z)


def _outside(pose: Pose, geometry: object, point: Vector3) -> float:
    """Return the distance of a point from a solid [m]; of a mesh, from its bounding box."""
    x, y, z = pose.inverse().transform_point(point)
    match geometry:
        case Box(size=(a, b, c)):
            return math.hypot(max(abs(x) - a / 2, 0.0), max(abs(y) - b / 2, 0.0), max(abs(z) - c / 2, 0.0))
        case Sphere(radius=radius):
            return max(math.hypot(x, y, z) - radius, 0.0)
        case Cylinder(radius=radius, length=length):
            return math.hypot(max(math.hypot(x, y) - radius, 0.0), max(abs(z) - length / 2, 0.0))
        case Cone(radius=radius, length=length):
            share = min(max(0.5 - z / length, 0.0), 1.0) if length > 0.0 else 1.0
            return math.hypot(max(math.hypot(x, y) - radius * share, 0.0), max(abs(z) - length / 2, 0.0))
        case _:
            vertices: Any = getattr(geometry, "vertices", np.zeros((1, 3)))
            low, high = vertices.min(axis=0), vertices.max(axis=0)
            local = np.array([x, y, z])
            return float(np.linalg.norm(np.maximum(np.maximum(low - local, local - high), 0.0)))
