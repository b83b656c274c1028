"""Group, limits and constraints of a request as the C++ needs them."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from trundle.base.diagnostics import UsageError, no_such
from trundle.planning import _planning
from trundle.planning.planning_scene import PlanningScene, pieces_of, pose_row
from trundle.spatial import Pose, quaternion_product

from .constraints import Constraints, OrientationConstraint, PositionConstraint, VisibilityConstraint
from .error_codes import ErrorCode, RequestError
from .requests import PlannerSettings, Positions, WorkspaceBounds

NO_CONSTRAINTS = Constraints()
DEFAULT_SETTINGS = PlannerSettings()
DEFAULT_WORKSPACE = WorkspaceBounds()
_SWEEP = 0.0002
"""Motion of a link's points up to which nothing between two states of a path is looked at [m]."""
_UNBOUNDED = 1e3
"""Limit of a prismatic joint without one [m]."""
_AXES = {"z": 2, "y": 1, "x": 0}
_PARAMETERIZATIONS = {"xyz_euler_angles": 1, "rotation_vector": 2}
_NO_POSES = np.zeros((0, 7))


class GroupProblem:
    """A group of a scene, in the terms of `_planning`."""

    def __init__(
        self,
        scene: PlanningScene,
        group: str,
        reference: Positions,
        *,
        path_constraints: Constraints = NO_CONSTRAINTS,
        settings: PlannerSettings = DEFAULT_SETTINGS,
        workspace: WorkspaceBounds = DEFAULT_WORKSPACE,
        avoids_collisions: bool = True,
    ) -> None:
        """Prepare.

        Args:
            scene: scene, which is not changed.
            group: group of the scene's model.
            reference: state of all variables; those of the group are replaced by planners.
            path_constraints: constraints that hold on the whole path.
            settings: planner's settings.
            workspace: limits of planar and floating joints.
            avoids_collisions: False: only limits and constraints count.

        Raises:
            RequestError: no such group, or constraints that cannot be.
        """
        model = scene.model
        if group not in model.groups:
            raise RequestError(ErrorCode.INVALID_GROUP_NAME, no_such("no group", group, model.groups))
        self.scene = scene
        self.model = model
        self.group = model.groups[group]
        self.variables = self.group.variables
        if not self.variables:
            raise RequestError(ErrorCode.INVALID_GROUP_NAME, f"group {group!r} has no joint that moves")
        self.indices = model.indices(self.variables)
        self.reference = np.array(reference, dtype=np.float64)
        dimensions = self._dimensions(workspace)
        for joint in path_constraints.joints:
            self._narrow(dimensions, joint.variable, joint.position, joint.tolerance_below, joint.tolerance_above)
        self.dimensions = dimensions
        self.avoids_collisions = avoids_collisions
        poses, visibilities = self._constraints(path_constraints)
        self.task = _planning.group_task(
            dimensions,
            self.indices.tolist(),
            self.reference,
            scene.mask(group),
            poses,
            visibilities,
            settings.longest_valid_segment_fraction,
            _SWEEP,
            avoids_collisions,
        )

    def state_of(self, values: Positions) -> Positions:
        """Return whole states (…, variables) of the group's values (…, n), mimic joints included."""
        values = np.asarray(values, dtype=np.float64)
        states = np.broadcast_to(self.reference, (*values.shape[:-1], len(self.reference))).copy()
        states[..., self.indices] = values
        return self.model.with_mimics(states)

    def goal(self, constraints: Constraints, notes: list[str] | None = None) -> _planning.Goal:
        """Return a goal of constraints.

        Args:
            constraints: constraints of the goal.
            notes: receives what was changed: a joint's goal beyond its limits is its limit, as in MoveIt's constraints;
                None: such a goal is refused, as by pilz' planners.

        Raises:
            RequestError: constraints that cannot be.
        """
        rows: list[tuple[float, float, float, float]] = []
        number = {name: index for index, name in enumerate(self.variables)}
        for joint in constraints.joints:
            index = number.get(joint.variable)
            if index is None:
                if joint.variable in self.model.variables:
                    self._check_fixed(joint.variable, joint.position, joint.tolerance_below, joint.tolerance_above)
                    continue
                raise RequestError(
                    ErrorCode.INVALID_GOAL_CONSTRAINTS, no_such("no variable", joint.variable, self.variables)
                )
            bounds = np.array([joint.position, joint.tolerance_below, joint.tolerance_above])
            if not np.isfinite(bounds).all():
                raise RequestError(
                    ErrorCode.INVALID_GOAL_CONSTRAINTS, f"{joint.variable!r}: a joint constraint needs finite numbers"
                )
            low, high = joint.position - abs(joint.tolerance_below), joint.position + abs(joint.tolerance_above)
            if not self.dimensions[index, 2]:
                lower, upper = self.dimensions[index, :2]
                if high < lower or low > upper:
                    fault = f"the goal {joint.position:g} is beyond the limits {lower:g} … {upper:g}"
                    if notes is None:
                        raise RequestError(ErrorCode.GOAL_CONSTRAINTS_VIOLATED, f"{joint.variable!r}: {fault}")
                    low = high = lower if high < lower else upper
                    notes.append(f"{joint.variable!r}: {fault}; the path ends at {low:g}")
                low, high = max(low, lower), min(high, upper)
            rows.append((index, low, min(max(joint.position, low), high), high))
        poses, visibilities = self._constraints(constraints)
        return _planning.goal(np.array(rows, dtype=np.float64).reshape(-1, 4), poses, visibilities)

    def _check_fixed(self, variable: str, position: float, below: float, above: float) -> None:
        value = self.reference[self.model.variable_index(variable)]
        if not position - abs(below) - 1e-9 <= value <= position + abs(above) + 1e-9:
            raise RequestError(
                ErrorCode.GOAL_CONSTRAINTS_VIOLATED,
                f"{variable!r} is at {value:g}, not at {position:g}, and group {self.group.name!r} does not move it",
            )

    def _dimensions(self, workspace: WorkspaceBounds) -> NDArray[np.float64]:
        """Return (n, 4) lower, upper, turns without end, first of a quaternion."""
        rows: list[tuple[float, float, float, float]] = []
        for name in self.group.joints:
            joint = self.model.joint(name)
            for k, (lower, upper, is_bounded) in enumerate(
                zip(joint.lower, joint.upper, joint.is_bounded, strict=True)
            ):
                kind = joint.type
                if kind == "floating" and k >= 3:
                    rows.append((-1.0, 1.0, 0.0, float(k == 3)))
                elif kind == "continuous" or (kind == "planar" and k == 2 and not is_bounded):
                    rows.append((-np.pi, np.pi, 1.0, 0.0))
                elif kind in ("planar", "floating"):
                    rows.append((max(lower, workspace.low[k]), min(upper, workspace.high[k]), 0.0, 0.0))
                else:
                    rows.append((max(lower, -_UNBOUNDED), min(upper, _UNBOUNDED), 0.0, 0.0))
        return np.array(rows, dtype=np.float64).reshape(-1, 4)

    def _narrow(self, dimensions: NDArray[np.float64], variable: str, at: float, below: float, above: float) -> None:
        """Narrow the limits of a variable to a path constraint."""
        if variable not in self.variables:
            if variable not in self.model.variables:
                raise RequestError(ErrorCode.INVALID_GOAL_CONSTRAINTS, no_such("no variable", variable, self.variables))
            return
        row = dimensions[self.variables.index(variable)]
        low, high = at - abs(below), at + abs(above)
        if not np.isfinite([low, high]).all():
            raise RequestError(ErrorCode.INVALID_GOAL_CONSTRAINTS, f"{variable!r}: a constraint needs finite numbers")
        if row[2] and high - low >= 2 * np.pi:
            return
        if row[2] and -np.pi <= low and high <= np.pi:
            row[:3] = low, high, 0.0
            return
        lower, upper = max(low, row[0]), min(high, row[1])
        if lower > upper:
            raise RequestError(
                ErrorCode.INVALID_GOAL_CONSTRAINTS, f"{variable!r}: no position satisfies the path constraints"
            )
        row[:2] = lower, upper

    def _constraints(
        self, constraints: Constraints
    ) -> tuple[list[_planning.PoseConstraint], list[_planning.VisibilityConstraint]]:
        try:
            poses = [self._position(constraint) for constraint in constraints.positions]
            poses += [self._orientation(constraint) for constraint in constraints.orientations]
            visibilities = [self._visibility(constraint) for constraint in constraints.visibilities]
        except UsageError as error:
            raise RequestError(ErrorCode.INVALID_GOAL_CONSTRAINTS, str(error)) from None
        return poses, visibilities

    def link_number(self, link: str) -> int:
        """Return the number of a link.

        Raises:
            RequestError: no such link.
        """
        if link not in self.model.links:
            raise RequestError(ErrorCode.INVALID_LINK_NAME, no_such("no link", link, self.model.links))
        return self.model.links.index(link)

    def _frame(self, frame: str) -> tuple[int, Pose]:
        """Return a link, or -1 for the model frame, and the pose of the frame in it."""
        if frame in self.model.links:
            return self.model.links.index(frame), Pose()
        try:
            return -1, self.scene.frame_pose(frame)
        except UsageError as error:
            raise RequestError(ErrorCode.FRAME_TRANSFORM_FAILURE, str(error)) from None

    def _position(self, constraint: PositionConstraint) -> _planning.PoseConstraint:
        link = self.link_number(constraint.link)
        frame, pose = self._frame(constraint.frame)
        placed = [type(shape)(shape.geometry, pose @ shape.pose) for shape in constraint.region]
        region = pieces_of(placed, f"position constraint of {constraint.link!r}", moves=False)
        if not region.shapes:
            raise UsageError(f"the position constraint of {constraint.link!r} has no region")
        return _planning.pose_constraint(
            link, frame, _vector(constraint.offset), region.shapes, region.poses, 0, _UNIT, np.zeros(3)
        )

    def _orientation(self, constraint: OrientationConstraint) -> _planning.PoseConstraint:
        link = self.link_number(constraint.link)
        frame, pose = self._frame(constraint.frame)
        row = np.array(pose_row(Pose(quaternion=constraint.orientation)))
        w, x, y, z = quaternion_product(pose.quaternion, (row[6], row[3], row[4], row[5]))
        tolerances = np.abs(_vector(constraint.tolerances))
        kind = _PARAMETERIZATIONS[constraint.parameterization]
        return _planning.pose_constraint(
            link, frame, np.zeros(3), [], _NO_POSES, kind, np.array([x, y, z, w]), tolerances
        )

    def _visibility(self, constraint: VisibilityConstraint) -> _planning.VisibilityConstraint:
        sensor, sensor_frame = self._frame(constraint.sensor_frame)
        target, target_frame = self._frame(constraint.target_frame)
        poses = [pose_row(sensor_frame @ constraint.sensor_pose), pose_row(target_frame @ constraint.target_pose)]
        numbers = (constraint.target_radius, constraint.max_view_angle, constraint.max_range_angle)
        if not np.isfinite(numbers).all():
            raise UsageError("a visibility constraint needs finite numbers")
        return _planning.visibility_constraint(
            sensor,
            target,
            np.array(poses),
            _AXES[constraint.sensor_view_direction],
            abs(constraint.target_radius),
            constraint.cone_sides,
            constraint.max_view_angle,
            constraint.max_range_angle,
        )


_UNIT = np.array([0.0, 0.0, 0.0, 1.0])


def _vector(numbers: Sequence[float]) -> NDArray[np.float64]:
    vector = np.array(numbers, dtype=np.float64)
    if not np.isfinite(vector).all():
        raise UsageError("a constraint needs finite numbers")
    return vector
