"""Link poses and Jacobians."""

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from trundle.base.built import refuse_stale
from trundle.base.diagnostics import UsageError, no_such
from trundle.planning import _planning
from trundle.planning.robot_model import JointModel, JointModelGroup, RobotModel
from trundle.spatial import Pose

refuse_stale(_planning)
_KINDS = ("fixed", "revolute", "prismatic", "planar", "floating")
Numbers = NDArray[np.float64]


class Kinematics:
    """Kinematics of a robot model; poses are in the model frame, as rows x, y, z [m], qx, qy, qz, qw."""

    def __init__(self, model: RobotModel) -> None:
        """Take a model."""
        self.model = model
        self._groups: dict[tuple[str, str], _planning.GroupKinematics] = {}

    @cached_property
    def tree(self) -> _planning.TreeKinematics:
        """The same in C++."""
        model = self.model
        index = {link: i for i, link in enumerate(model.links)}
        joints = [[_kind(joint), index.get(joint.parent_link, -1), *self._variables(joint)] for joint in model.joints]
        numbers = [
            [
                *pose_row(joint.origin),
                *joint.axis,
                *((1.0, 0.0) if joint.mimic is None else (joint.mimic.multiplier, joint.mimic.offset)),
            ]
            for joint in model.joints
        ]
        return _planning.TreeKinematics(np.array(joints, dtype=np.int64), np.array(numbers, dtype=np.float64))

    def _variables(self, joint: JointModel) -> tuple[int, int]:
        first = self.model.variable_index(joint.variables[0]) if joint.variables else -1
        return first, -1 if joint.mimic is None else self.model.variable_index(joint.mimic.joint)

    def link_poses(self, positions: Numbers) -> Numbers:
        """Return the poses of all links, in the order of `model.links`.

        Args:
            positions: a state (variables,), or states (n, variables); mimic joints follow their leaders.

        Returns:
            (links, 7), or (n, links, 7).
        """
        states = np.ascontiguousarray(positions, dtype=np.float64)
        poses = self.tree.link_poses(np.atleast_2d(states))
        return poses if states.ndim > 1 else poses[0]

    def link_pose(self, positions: Numbers, link: str) -> Pose:
        """Return the pose of a link.

        Raises:
            UsageError: no such link.
        """
        if link not in self.model.links:
            raise UsageError(no_such("no link", link, self.model.links))
        return row_pose(self.link_poses(positions)[self.model.links.index(link)])

    def jacobian(self, group: str, positions: Numbers, tip: str | None = None) -> Numbers:
        """Return the Jacobian of a tip link's origin.

        Args:
            group: group's name.
            positions: a state.
            tip: link; None: the group's tip.

        Returns:
            (6, n): linear [m] and angular velocity [rad] per unit of each of the group's variables, in the model frame;
            a joint's mimics move with it. MoveIt's getJacobian has the same in the frame of the group's base.

        Raises:
            UsageError: no such group or link; the group has no tip of its own, or does not move this one.
        """
        parts = self.model.group(group)
        name = default_tip(parts) if tip is None else tip
        chain = self._groups.get((group, name))
        if chain is None:
            chain = self.group_kinematics(parts, name, Pose())
            self._groups[group, name] = chain
        return chain.jacobian(np.ascontiguousarray(positions, dtype=np.float64))

    def manipulability(self, group: str, positions: Numbers, tip: str | None = None) -> float:
        """Return Yoshikawa's manipulability: the product of the Jacobian's singular values; 0 in a singularity.

        See "Manipulability of Robotic Mechanisms", 1985. `jacobian` has the arguments and errors.
        """
        return _planning.manipulability(self.jacobian(group, positions, tip))[0]

    def singularity(self, group: str, positions: Numbers, tip: str | None = None) -> float:
        """Return the Jacobian's condition number, inf in a singularity. `jacobian` has the arguments and errors."""
        ratio = _planning.manipulability(self.jacobian(group, positions, tip))[1]
        return 1.0 / ratio if ratio > 0.0 else float("inf")

    def group_kinematics(self, group: JointModelGroup, tip: str, link_from_tip: Pose) -> _planning.GroupKinematics:
        """Return a group's joints to a tip, in C++.

        Raises:
            UsageError: no such link, or the group does not move it.
        """
        model = self.model
        if tip not in model.links:
            raise UsageError(no_such("no link", tip, model.links))
        indices = model.indices(group.variables)
        turns = np.array([self._is_angle(name) for name in group.variables], dtype=np.bool_)
        columns = np.stack([indices, model.is_bounded[indices], turns], axis=1).astype(np.int64)
        limits = np.stack([model.lower[indices], model.upper[indices]], axis=1)
        row = np.array(pose_row(link_from_tip))
        try:
            return _planning.GroupKinematics(self.tree, model.links.index(tip), row, columns, limits)
        except ValueError as error:
            raise UsageError(f"group {group.name!r} and link {tip!r}: {error}") from None

    def _is_angle(self, variable: str) -> bool:
        """Return True if whole turns of a variable change nothing: no joint follows it by a fraction."""
        if variable.endswith("/theta"):
            return True
        joint = self.model.joint(variable) if self.model.has_joint(variable) else None
        followers = [other.mimic for other in self.model.joints if other.mimic and other.mimic.joint == variable]
        return joint is not None and joint.type in ("revolute", "continuous") and not followers


def default_tip(group: JointModelGroup) -> str:
    """Return the tip of a group that has one.

    Raises:
        UsageError: it has several.
    """
    if len(group.tips) != 1:
        raise UsageError(f"group {group.name!r} has no single tip; name one of {', '.join(map(repr, group.links))}")
    return group.tips[0]


def _kind(joint: JointModel) -> int:
    return 1 if joint.type == "continuous" else _KINDS.index(joint.type)


def pose_row(pose: Pose) -> tuple[float, ...]:
    """Return x, y, z, qx, qy, qz, qw."""
    w, *xyz = pose.quaternion
    return (*pose.position, *xyz, w)


def row_pose(row: Numbers) -> Pose:
    """Return the pose of x, y, z, qx, qy, qz, qw."""
    x, y, z, qx, qy, qz, qw = row.tolist()
    return Pose((x, y, z), (qw, qx, qy, qz))
