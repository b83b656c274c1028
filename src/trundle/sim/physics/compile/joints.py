"""Joints as MuJoCo joints, with loop, mimic and gear constraints.

A link with two parents is split into two equal halves, one per parent, welded together, so that a joint that closes a
loop has limits, motor and position like any other.
"""

import math
from collections.abc import Mapping

import mujoco
from msgspec import Struct
from msgspec.structs import replace

from trundle.base.diagnostics import Diagnostics
from trundle.robots.model import Joint, JointAxis, JointType, Mimic
from trundle.spatial import Pose, Vector3, rotation_from_z

from .kinematic_tree import JointEdge, KinematicTree, is_rigid
from .solver_settings import SOLIMP, equality_solref, friction_solref, limit_solref

_NO_EFFORT = 1e-9
"""Effort limit in place of zero [N·m or N]: MuJoCo's range must not be empty."""
_HARD_STOP = 1e8
"""SDF's default stiffness of a limit [N/m or N·m/rad]."""
_PARALLEL = 0.9999
"""Cosine of 0.8°; two axes at a smaller angle count as parallel."""
_PLANAR_SUFFIXES = ("::x", "::y")
_TWO_HINGES = frozenset({JointType.UNIVERSAL, JointType.REVOLUTE2})


class Axis(Struct, frozen=True):
    """Axis of a joint; a ball joint has one Axis for its three degrees of freedom."""

    joint: str
    """`model::joint`"""
    engine_joint: str
    axis: JointAxis | None
    """None for a ball joint."""
    sign: float = 1.0
    """−1 if MuJoCo's position has the opposite sign."""


class JointBuilder:
    """Adds joints and constraints to a specification."""

    def __init__(self, spec: mujoco.MjSpec, report: Diagnostics) -> None:
        self._spec = spec
        self._report = report
        self.axes: dict[str, list[Axis]] = {}
        """Joint → its axes, in file order."""

    def add(self, body: mujoco.MjsBody, edge: JointEdge, world_from_child: Pose) -> None:
        """Add a joint's axes to its child body, whose frame is the link's."""
        joint = edge.joint
        frame = world_from_child.inverse()
        anchor = frame.transform_point(edge.world_from_joint.position)
        if is_rigid(joint):
            if joint.axis is not None and joint.type is not JointType.FIXED:
                problem = f"lower = upper = {joint.axis.lower:g} leaves no freedom; rigid"
                self._report.info(joint.at, f"joint {joint.name!r}: {problem}", "joint-physics")
            return
        if joint.type is JointType.BALL:
            body.add_joint(name=edge.name, type=mujoco.mjtJoint.mjJNT_BALL, pos=anchor)
            self.axes[edge.name] = [Axis(edge.name, edge.name, None, -1.0 if edge.is_reversed else 1.0)]
            return
        written = _planar(joint.axis) if joint.type is JointType.PLANAR else [(joint.axis, "")]
        if joint.type in _TWO_HINGES:
            written = [(joint.axis, "::axis"), (joint.axis2, "::axis2")]
            if joint.axis is not None and joint.axis2 is not None and _are_parallel(joint.axis, joint.axis2):
                problem = "its two axes are parallel; the second is left out"
                self._report.warn(joint.at, f"joint {joint.name!r}: {problem}", "joint-physics")
                written.pop()
        axes: list[Axis] = []
        # The first joint of a body is the outermost: in a reversed joint the last axis comes first.
        for axis, suffix in reversed(written) if edge.is_reversed else written:
            if axis is None or (axis.is_rigid and axis.mimic is None):
                continue
            name = f"{edge.name}{suffix}"
            slides = joint.type is JointType.PRISMATIC or suffix in _PLANAR_SUFFIXES
            self._add_axis(body, name, anchor, frame.transform_vector(edge.direction(axis)), joint, axis, slides=slides)
            axes.append(Axis(edge.name, name, axis))
        if joint.type is JointType.SCREW and joint.axis is not None:
            self._add_screw(body, edge, anchor, frame.transform_vector(edge.direction(joint.axis)))
        self.axes[edge.name] = axes[::-1] if edge.is_reversed else axes

    def _add_axis(
        self,
        body: mujoco.MjsBody,
        name: str,
        anchor: Vector3,
        direction: Vector3,
        joint: Joint,
        axis: JointAxis,
        *,
        slides: bool,
    ) -> None:
        h = self._spec.option.timestep
        hinge = body.add_joint(
            name=name,
            type=mujoco.mjtJoint.mjJNT_SLIDE if slides else mujoco.mjtJoint.mjJNT_HINGE,
            pos=anchor,
            axis=direction,
            frictionloss=self._non_negative(axis.friction, "friction", joint),
            springref=axis.spring_reference,
        )
        hinge.damping[0] = self._non_negative(axis.damping, "damping", joint)
        hinge.stiffness[0] = self._non_negative(axis.spring_stiffness, "spring_stiffness", joint)
        hinge.solref_friction = friction_solref(h)
        hinge.solref_limit, hinge.solimp_limit = limit_solref(h), SOLIMP
        is_limited = not axis.is_rigid and (math.isfinite(axis.lower) or math.isfinite(axis.upper))
        hinge.limited = mujoco.mjtLimited.mjLIMITED_TRUE if is_limited else mujoco.mjtLimited.mjLIMITED_FALSE
        if is_limited:
            lower, upper = sorted((axis.lower, axis.upper))
            if lower != axis.lower:
                problem = f"joint {joint.name!r}: lower {upper:g} is above upper {lower:g}; physics swaps them"
                self._report.warn(joint.at, problem, "swapped-limits")
            hinge.range = [max(lower, -1e10), min(upper, 1e10)]
            if axis.stop_stiffness < _HARD_STOP:
                problem = "a limit's <stiffness> and <dissipation> are ignored, as in Gazebo's ODE; the stop is hard"
                self._report.info(joint.at, f"joint {joint.name!r}: {problem}", "engine-tuning")
        if math.isfinite(axis.effort) and axis.effort >= 0:
            hinge.actfrclimited = mujoco.mjtLimited.mjLIMITED_TRUE
            effort = max(axis.effort, _NO_EFFORT)
            hinge.actfrcrange = [-effort, effort]

    def _non_negative(self, value: float, parameter: str, joint: Joint) -> float:
        if value >= 0 and math.isfinite(value):
            return value
        self._report.warn(
            joint.at,
            f"joint {joint.name!r}: {parameter} {value:g} would add energy; physics uses 0",
            "negative-damping",
        )
        return 0.0

    def _add_screw(self, body: mujoco.MjsBody, edge: JointEdge, anchor: Vector3, direction: Vector3) -> None:
        """Add a screw: translation −angle / thread_pitch along its axis."""
        pitch, advance = edge.joint.thread_pitch, f"{edge.name}::advance"
        if pitch == 0 or not math.isfinite(pitch):
            problem = f"thread_pitch {pitch:g} is not usable; the joint turns without advancing"
            self._report.warn(edge.joint.at, f"joint {edge.joint.name!r}: {problem}", "out-of-range")
            return
        body.add_joint(name=advance, type=mujoco.mjtJoint.mjJNT_SLIDE, pos=anchor, axis=direction)
        self._couple(advance, edge.name, ratio=-1.0 / pitch)

    def _couple(self, follower: str, leader: str, *, ratio: float, offset: float = 0.0) -> None:
        """Constrain follower = offset + ratio · leader."""
        tie = self._spec.add_equality(type=mujoco.mjtEq.mjEQ_JOINT, name1=follower, name2=leader)
        tie.objtype = mujoco.mjtObj.mjOBJ_JOINT
        tie.data = [offset, ratio, *[0.0] * (len(tie.data) - 2)]
        tie.solref, tie.solimp = equality_solref(self._spec.option.timestep), SOLIMP

    def weld(self, half: str, other: str, *, as_one: bool) -> None:
        """Weld two halves of a link in their relative pose at zero joint positions, or (`as_one`) in the same pose."""
        weld = self._spec.add_equality(type=mujoco.mjtEq.mjEQ_WELD, name1=half, name2=other)
        weld.objtype = mujoco.mjtObj.mjOBJ_BODY
        weld.data = [0.0] * 6 + [float(as_one), 0.0, 0.0, 0.0, 1.0] + [0.0] * (len(weld.data) - 11)
        weld.solref, weld.solimp = equality_solref(self._spec.option.timestep), SOLIMP

    def couple_joints(self, tree: KinematicTree) -> None:
        """Add mimic and gearbox constraints, after all joints."""
        for edge in tree.joints:
            prefix = edge.name.removesuffix(edge.joint.name)
            for axis in self.axes.get(edge.name, []):
                if axis.axis is not None and axis.axis.mimic is not None:
                    self._mimic(axis, axis.axis.mimic, prefix, edge.joint)
            if edge.joint.type is JointType.GEARBOX:
                self._add_gearbox(edge, prefix, tree)

    def _mimic(self, follower: Axis, mimic: Mimic, prefix: str, joint: Joint) -> None:
        leaders = self.axes.get(f"{prefix}{mimic.joint}", [])
        if len(leaders) <= mimic.axis or leaders[mimic.axis].axis is None or leaders[mimic.axis] == follower:
            problem = f"mimics {mimic.joint!r}, which has no such axis; it moves freely"
            self._report.warn(joint.at, f"joint {joint.name!r} {problem}", "mimic")
            return
        offset = mimic.offset - mimic.multiplier * mimic.reference
        self._couple(follower.engine_joint, leaders[mimic.axis].engine_joint, ratio=mimic.multiplier, offset=offset)

    def _add_gearbox(self, edge: JointEdge, prefix: str, tree: KinematicTree) -> None:
        """Constrain (child over reference) = −ratio · (parent over reference)."""
        joint = edge.joint
        reference = f"{prefix}{joint.gearbox_reference_body}"
        wheels = [
            self._hinge_between(link, reference, axis, edge, tree.parent_joint)
            for link, axis in ((edge.parent, joint.axis), (edge.child, joint.axis2))
        ]
        driver, driven = wheels
        if driver is None or driven is None:
            problem = "parent and child must each be connected to the reference body by a revolute joint; left out"
            self._report.warn(joint.at, f"joint {joint.name!r}: {problem}", "gearbox")
            return
        ratio = -joint.gearbox_ratio * driver[1] * driven[1]
        self._couple(driven[0], driver[0], ratio=ratio)

    def _hinge_between(
        self,
        link: str,
        reference: str,
        axis: JointAxis | None,
        gearbox: JointEdge,
        parent_joint: Mapping[str, JointEdge],
    ) -> tuple[str, float] | None:
        """Return the joint between a link and the reference body, and the sign of its rotation."""
        for low, high, sign in ((link, reference, 1.0), (reference, link, -1.0)):
            edge = parent_joint.get(low)
            if edge is None or edge.parent != high or axis is None:
                continue
            axes = self.axes.get(edge.name, [])
            if len(axes) == 1 and axes[0].axis is not None:
                along = edge.direction(axes[0].axis)
                gearbox_axis = gearbox.world_from_axes.transform_vector(axis.direction)
                agree = sum(a * b for a, b in zip(along, gearbox_axis, strict=True)) >= 0
                return axes[0].engine_joint, sign if agree else -sign
        return None


def _planar(axis: JointAxis | None) -> list[tuple[JointAxis | None, str]]:
    """Return the three axes of a planar joint: two translations normal to its axis and the rotation about it."""
    if axis is None:
        return []
    plane = Pose(quaternion=rotation_from_z(axis.direction))
    directions = (plane.transform_vector((1.0, 0.0, 0.0)), plane.transform_vector((0.0, 1.0, 0.0)))
    return [
        *(
            (replace(axis, direction=direction), name)
            for direction, name in zip(directions, _PLANAR_SUFFIXES, strict=True)
        ),
        (axis, "::turn"),
    ]


def _are_parallel(a: JointAxis, b: JointAxis) -> bool:
    return abs(sum(x * y for x, y in zip(a.direction, b.direction, strict=True))) > _PARALLEL
