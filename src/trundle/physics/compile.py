"""Turns a World into a MuJoCo model, and keeps what was what.

A link is a body, whatever order the file has them in; what moves freely is a tree that starts at a link nobody
holds. A joint whose limits leave no freedom (the 0..0 of many published robots) becomes none: its child is fixed.
"""

import math
import warnings
from collections.abc import Mapping
from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from trundle.diagnostics import DescriptionError, Diagnostics
from trundle.model import Joint, JointAxis, JointType, Link, Model, Plane, World, model_from_links
from trundle.spatial import Pose

from .contacts import add_contacts
from .inertia import principal_inertia
from .settings import SOLIMP, apply_settings, contact_solref, friction_solref
from .shapes import ShapeEntry, add_shape, name_unsupported

_NO_EFFORT = 1e-9
"""[N·m or N] What an effort limit of zero becomes: MuJoCo wants a range that is not empty."""
_SIMULATED = frozenset({JointType.REVOLUTE, JointType.PRISMATIC, JointType.FIXED, JointType.BALL, JointType.UNIVERSAL})


@dataclass(frozen=True, slots=True, eq=False)
class CompiledWorld:
    """A MuJoCo model and the way from the world's names to its numbers; links and joints are in file order."""

    world: World
    model: mujoco.MjModel
    link_names: tuple[str, ...]
    """`model::link`"""
    joint_names: tuple[str, ...]
    """`model::joint`"""
    link_bodies: NDArray[np.intp]
    joint_qpos: NDArray[np.intp]
    """Where each joint's position is in qpos; −1 where it has no freedom of one axis."""
    joint_dof: NDArray[np.intp]
    """Where its velocity is in qvel; −1 likewise."""
    joint_actuators: NDArray[np.intp]
    """Its motor; −1 likewise."""


def compile_world(world: World, report: Diagnostics) -> CompiledWorld:
    """Compile; what the engine cannot use as written is mended, aloud.

    Raises:
        DescriptionError: the engine refuses what is left.
    """
    return _Compiler(world, report).compile()


class _Compiler:
    def __init__(self, world: World, report: Diagnostics) -> None:
        self.world = world
        self.report = report
        self.spec = mujoco.MjSpec()
        self.spec.modelname = world.name
        apply_settings(self.spec)
        self.spec.option.timestep = world.physics.max_step_size_s
        self.spec.option.gravity = world.physics.gravity
        self.shapes: list[ShapeEntry] = []
        self.shape_names: set[str] = set()
        self.moving_joints: set[str] = set()

    def compile(self) -> CompiledWorld:
        for index, model in enumerate(self.world.models):
            self._add_model(index, model)
        for joint in self.world.joints:
            what = f"joint {joint.name!r}: joints between models are not simulated yet; it is left out"
            self.report.warn(joint.at, what)
        add_contacts(self.spec, self.shapes, self.world.models)
        for name in sorted(self.moving_joints):
            self._add_motor(name)
        compiled = self._compile_spec()
        joints = [f"{m.name}::{j.name}" for m in self.world.models for j in m.joints]
        links = [f"{m.name}::{link.name}" for m in self.world.models for link in m.links]
        mj_joints = [compiled.joint(name) if name in self.moving_joints else None for name in joints]
        return CompiledWorld(
            world=self.world,
            model=compiled,
            link_names=tuple(links),
            joint_names=tuple(joints),
            link_bodies=np.array([compiled.body(name).id for name in links], dtype=np.intp),
            joint_qpos=np.array([-1 if j is None else j.qposadr[0] for j in mj_joints], dtype=np.intp),
            joint_dof=np.array([-1 if j is None else j.dofadr[0] for j in mj_joints], dtype=np.intp),
            joint_actuators=np.array(
                [-1 if j is None else compiled.actuator(name).id for name, j in zip(joints, mj_joints, strict=True)],
                dtype=np.intp,
            ),
        )

    def _compile_spec(self) -> mujoco.MjModel:
        """Hand the world to MuJoCo; its own checks speak in its own words."""
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            try:
                compiled = self.spec.compile()
            except ValueError as error:
                what = " ".join(str(error).split())
                raise DescriptionError(self.world.at, f"the engine cannot simulate this: {what}") from None
        for warning in caught:
            self.report.warn(self.world.at, f"the engine is in doubt: {' '.join(str(warning.message).split())}")
        return compiled

    def _add_model(self, index: int, model: Model) -> None:
        links = {link.name: link for link in model.links}
        held = self._holding_joints(model, links)
        bodies: dict[str, mujoco.MjsBody] = {}
        # A joint without freedom stands where its limits hold it, which need not be zero.
        held_at = {j.name: j.axis.lower for j in model.joints if j.axis is not None and j.axis.is_rigid}
        model_from_link = model_from_links(model, held_at)

        def place(link: Link) -> mujoco.MjsBody:
            if link.name in bodies:
                return bodies[link.name]
            joint = held.get(link.name)
            if joint is None or joint.parent == "world":
                parent, pose = self.spec.worldbody, model.world_from_model @ model_from_link[link.name]
            else:
                above = links[joint.parent]
                parent, pose = place(above), model_from_link[above.name].inverse() @ model_from_link[link.name]
            body = self._add_body(parent, f"{model.name}::{link.name}", link, pose, fixed=model.static)
            if joint is not None and not model.static:
                self._add_joint(body, model, link, joint)
            elif not model.static and not link.fixed:
                body.add_freejoint(name=f"{model.name}::{link.name}::free")
            bodies[link.name] = body
            return body

        for link in model.links:
            body = place(link)
            for collision in link.collisions:
                name_unsupported(collision, self.report)
                name = self._shape_name(f"{model.name}::{link.name}::{collision.name}")
                if isinstance(collision.geometry, Plane) and not model.static:
                    self.report.warn(collision.at, f"collision {collision.name!r}: a plane cannot move; it is left out")
                    continue
                geom = add_shape(self.spec, body, collision, name, self.report)
                if geom is not None:
                    entry = ShapeEntry(geom, name, index, link.name, model.static, collision.surface)
                    self.shapes.append(entry)

    def _shape_name(self, name: str) -> str:
        """The name, made unique: collisions of one link may share theirs."""
        unique, number = name, 2
        while unique in self.shape_names:
            unique, number = f"{name}#{number}", number + 1
        self.shape_names.add(unique)
        return unique

    def _holding_joints(self, model: Model, links: Mapping[str, Link]) -> dict[str, Joint]:
        """The one joint that holds each link; a second one, or one that closes a ring, is named and left out."""
        held: dict[str, Joint] = {}
        for joint in model.joints:
            above, seen = joint.parent, {joint.child}
            while above in held and above not in seen:
                seen.add(above)
                above = held[above].parent
            if joint.child in held or above in seen:
                self.report.warn(
                    joint.at, f"joint {joint.name!r} closes a loop of links, which is not simulated; it is left out"
                )
            elif joint.child in links:
                held[joint.child] = joint
        return held

    def _add_body(self, parent: mujoco.MjsBody, name: str, link: Link, pose: Pose, *, fixed: bool) -> mujoco.MjsBody:
        body = parent.add_body(name=name, pos=pose.position, quat=pose.quaternion)
        if not fixed:
            mass, axes, moments = principal_inertia(link, self.report)
            body.mass, body.inertia, body.explicitinertial = mass, moments, True
            body.ipos, body.iquat = axes.position, axes.quaternion
        if not link.gravity:
            body.gravcomp = 1.0
        return body

    def _add_joint(self, body: mujoco.MjsBody, model: Model, link: Link, joint: Joint) -> None:
        name = f"{model.name}::{joint.name}"
        if joint.type not in _SIMULATED:
            self.report.warn(
                joint.at, f"joint {joint.name!r}: {joint.type.value} joints are not simulated yet; it is rigid"
            )
            return
        if joint.type is JointType.BALL:
            body.add_joint(name=name, type=mujoco.mjtJoint.mjJNT_BALL, pos=joint.child_from_joint.position)
            return
        if joint.type is JointType.UNIVERSAL:
            for axis, suffix in ((joint.axis, "::axis"), (joint.axis2, "::axis2")):
                if axis is not None and not axis.is_rigid:
                    self._add_hinge(body, f"{name}{suffix}", link, joint, axis)
            return
        if joint.type is JointType.FIXED or joint.axis is None:
            return
        if joint.axis.is_rigid:
            self.report.info(
                joint.at, f"joint {joint.name!r}: lower = upper = {joint.axis.lower:g} leaves no freedom; rigid"
            )
            return
        self._add_hinge(body, name, link, joint, joint.axis)
        self.moving_joints.add(name)

    def _add_hinge(self, body: mujoco.MjsBody, name: str, link: Link, joint: Joint, axis: JointAxis) -> None:
        h = self.spec.option.timestep
        slide = joint.type is JointType.PRISMATIC
        hinge = body.add_joint(
            name=name,
            type=mujoco.mjtJoint.mjJNT_SLIDE if slide else mujoco.mjtJoint.mjJNT_HINGE,
            pos=joint.child_from_joint.position,
            axis=link.model_from_link.inverse().direction(axis.direction),
            damping=axis.damping,
            frictionloss=axis.friction,
            stiffness=axis.spring_stiffness,
            springref=axis.spring_reference,
        )
        hinge.solref_friction = friction_solref(h)
        hinge.solref_limit, hinge.solimp_limit = contact_solref(h), SOLIMP
        if math.isfinite(axis.lower) or math.isfinite(axis.upper):
            hinge.limited = mujoco.mjtLimited.mjLIMITED_TRUE
            lower, upper = sorted((axis.lower, axis.upper))
            if lower != axis.lower:
                what = f"joint {joint.name!r}: lower {upper:g} is above upper {lower:g}; physics swaps them"
                self.report.warn(joint.at, what)
            hinge.range = [max(lower, -1e10), min(upper, 1e10)]
        else:
            hinge.limited = mujoco.mjtLimited.mjLIMITED_FALSE
        if math.isfinite(axis.effort) and axis.effort >= 0:
            hinge.actfrclimited = mujoco.mjtLimited.mjLIMITED_TRUE
            effort = max(axis.effort, _NO_EFFORT)
            hinge.actfrcrange = [-effort, effort]

    def _add_motor(self, joint: str) -> None:
        """A motor that does nothing until it is told to: every gain is zero."""
        motor = self.spec.add_actuator(name=joint, target=joint, trntype=mujoco.mjtTrn.mjTRN_JOINT)
        motor.gaintype = mujoco.mjtGain.mjGAIN_FIXED
        motor.biastype = mujoco.mjtBias.mjBIAS_AFFINE
        motor.gainprm = [0.0] * len(motor.gainprm)
        motor.biasprm = [0.0] * len(motor.biasprm)
        motor.forcelimited = mujoco.mjtLimited.mjLIMITED_TRUE
        motor.forcerange = [-1.0, 1.0]
        motor.ctrllimited = mujoco.mjtLimited.mjLIMITED_FALSE
