"""Conversion of URDF to a model, as Gazebo simulates it.

Links at fixed joints are lumped; a massless link and its subtree are dropped; floating joints leave their child free. A
URDF's colors, which Gazebo drops, are kept.
"""

import math
from collections.abc import Mapping
from functools import partial
from pathlib import Path

from msgspec.structs import replace

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.base.xmlnode import XmlNode
from trundle.robots.model import (
    GREY,
    UNLIMITED,
    Box,
    Collision,
    Cylinder,
    Geometry,
    Inertial,
    Joint,
    JointAxis,
    JointType,
    Link,
    Material,
    MeshFile,
    Mimic,
    Model,
    Sphere,
    Visual,
    World,
)
from trundle.robots.packages import Packages
from trundle.robots.robot import (
    Robot,
    RobotBox,
    RobotCylinder,
    RobotInertial,
    RobotJoint,
    RobotLink,
    RobotMesh,
    RobotShape,
    RobotSphere,
    root_from_links,
)
from trundle.spatial import IDENTITY_QUATERNION, Pose, normalized

from ..sdf.context import Context, RawPose
from ..sdf.frames import MODEL, FrameGraph
from ..sdf.version import Version
from ..shape_names import is_lumped_name, shape_name
from .followers import plugin_followers
from .gazebo_tags import GazeboTags
from .lump import WORLD, Lump, follow_lumps, lump_links, lumped_inertial
from .massless import massless_lumps

_TYPES = {
    "revolute": JointType.REVOLUTE,
    "continuous": JointType.REVOLUTE,
    "prismatic": JointType.PRISMATIC,
    "fixed": JointType.FIXED,
    "planar": JointType.PLANAR,
}


def lower_robot(robot: Robot, root: XmlNode, *, folder: Path, packages: Packages, report: Diagnostics) -> World:
    """Convert a URDF's tree; `root` is its XML, for the <gazebo> blocks.

    Args:
        robot: URDF tree.
        root: <robot>.
        folder: base of relative mesh paths.
        packages: resolves URIs.
        report: receives a warning for each dropped part.
    """
    # <gazebo> blocks hold SDF by the rules of the version that Gazebo's conversion writes.
    context = Context(version=Version((1, 7)), folder=folder, packages=packages, report=report)
    model = _Lowering(robot, GazeboTags(root, context), context).model()
    return World(name=robot.name, at=robot.at, models=(model,))


class _Lowering:
    def __init__(self, robot: Robot, tags: GazeboTags, context: Context) -> None:
        self.robot = robot
        self.tags = tags
        self.context = context
        self.report = context.report
        self.links = {link.name: link for link in robot.links}
        preserved = frozenset(
            joint.name
            for joint in robot.joints
            if tags.flag(joint.name, "preserveFixedJoint") or tags.flag(joint.name, "disableFixedJointLumping")
        )
        self.lumps = lump_links(robot, preserved)
        self.lump_of = {link: lump.name for lump in self.lumps.values() for link, _ in lump.parts}

    def model(self) -> Model:
        """Return the robot as one model."""
        # All joints at zero: Gazebo's conversion ignores mimics, and their offsets do not affect link frames.
        poses = root_from_links(self.robot, {joint.name: 0.0 for joint in self.robot.joints})
        dropped = massless_lumps(self.robot, self.lumps, self.report)
        self._name_missing_meshes(dropped)
        links = tuple(
            self._link(lump, poses[lump.name])
            for lump in self.lumps.values()
            if lump.name not in dropped and lump.name != WORLD
        )
        plugins = self.tags.plugins("")
        followers = plugin_followers(plugins)
        joints = tuple(
            lowered
            for joint in self.robot.joints
            if self.lump_of[joint.child] not in dropped
            and (lowered := self._joint(joint, poses, followers)) is not None
        )
        canonical = self._first({link.name for link in links}) if links else None
        graph = FrameGraph(MODEL, self.report, canonical)
        for link in links:
            graph.add(link.name, RawPose(link.model_from_link), link.at)
            for part, pose in self.lumps[link.name].parts[1:]:
                graph.add(part, RawPose(pose, link.name), self.links[part].at, attached_to=link.name)
        links = (*links, *self.tags.links(graph))
        models = self.tags.models(graph)
        joints = (*joints, *self.tags.joints(graph))
        self.tags.name_tuning()
        for plugin in plugins:
            follow_lumps(plugin.node, self.lumps.values())
        static, self_collide, wind = (
            self.tags.flag("", name) or False for name in ("static", "self_collide", "enable_wind")
        )
        lump_of = self.lump_of
        lumped = {j.name for j in self.robot.joints if lump_of.get(j.parent) == lump_of[j.child]}
        self.tags.report_unread({*self.links, *(joint.name for joint in self.robot.joints)}, lumped)
        return Model(
            name=self.robot.name,
            at=self.robot.at,
            static=static,
            self_collide=self_collide,
            enable_wind=wind,
            links=links,
            joints=joints,
            models=models,
            plugins=plugins,
            canonical_link=canonical,
        )

    def _name_missing_meshes(self, dropped: set[str]) -> None:
        """Warn of missing meshes of dropped links, and of shapes on the world."""
        for name in sorted(dropped):
            for part, _ in self.lumps[name].parts:
                for shape in (*self.links[part].visuals, *self.links[part].collisions):
                    if isinstance(shape.geometry, RobotMesh):
                        self._path(shape.geometry.uri, shape)
        if WORLD in self.lumps:
            world = self.links[WORLD]
            if world.visuals or world.collisions:
                reason = f"link {WORLD!r} is the world itself: as in Gazebo its shapes are left out"
                self.report.warn(world.at, f"{reason}; a link below it, at a fixed joint, keeps them", "world-link")

    def _first(self, names: set[str]) -> str | None:
        """Return the first of some links in Gazebo's order: from the root down, children sorted by joint name.

        This is the canonical link whatever the file order: Jackal's file lists the wheels before the base.
        """
        children: dict[str, list[RobotJoint]] = {}
        for joint in sorted(self.robot.joints, key=lambda joint: joint.name, reverse=True):
            children.setdefault(joint.parent, []).append(joint)
        pending = [self.robot.root]
        while pending:
            link = pending.pop()
            if link in names:
                return link
            pending += [joint.child for joint in children.get(link, ())]
        return None

    def _inertials(self, lump: Lump) -> list[tuple[RobotInertial, Pose]]:
        inertials = [(self.links[name].inertial, pose) for name, pose in lump.parts]
        return [(inertial, pose) for inertial, pose in inertials if inertial is not None and inertial.mass > 0]

    def _link(self, lump: Lump, root_from_link: Pose) -> Link:
        root_link = self.links[lump.name]
        visuals: list[Visual] = []
        collisions: list[Collision] = []
        for name, pose in lump.parts:
            part = self.links[name]
            material = self.tags.material(name)
            visuals += self._visuals(lump.name, part, pose, material, len(visuals))
            collisions += self._collisions(lump.name, part, pose, len(collisions))
        flag = partial(self.tags.lumped_flag, lump)
        gravity_off, gravity = flag("turnGravityOff"), flag("gravity")
        linear_decay, angular_decay = self.tags.lumped_damping(lump)
        return Link(
            name=lump.name,
            at=root_link.at,
            model_from_link=root_from_link,
            inertial=self._inertial(lump),
            visuals=tuple(visuals),
            collisions=tuple(collisions),
            sensors=self.tags.lumped_sensors(lump),
            lights=tuple(
                replace(light, world_from_light=pose @ light.world_from_light)
                for name, pose in lump.parts
                for light in self.tags.lights(name)
            ),
            gravity=not gravity_off if gravity is None else gravity,
            self_collide=flag("selfCollide", "self_collide"),
            enable_wind=flag("enable_wind"),
            kinematic=flag("kinematic") or False,
            linear_decay=linear_decay,
            angular_decay=angular_decay,
        )

    def _inertial(self, lump: Lump) -> Inertial:
        inertial = self.links[lump.name].inertial
        orientation = None if inertial is None or inertial.mass <= 0 else inertial.link_from_com.quaternion
        return lumped_inertial(self._inertials(lump), orientation or IDENTITY_QUATERNION)

    def _visuals(self, lump: str, part: RobotLink, pose: Pose, gazebo: Material | None, first: int) -> list[Visual]:
        visuals: list[Visual] = []
        for number, shape in enumerate(part.visuals, first):
            visual = Visual(
                name=shape_name(lump, shape.name or part.name, "visual", number),
                geometry=self._geometry(shape),
                at=shape.at,
                link_from_visual=pose @ shape.link_from_shape,
                material=gazebo or self._material(shape),
                transparency=0.0 if gazebo or shape.rgba is None else 1.0 - shape.rgba[3],
            )
            visuals.append(self.tags.with_appearance(visual, part.name))
            if gazebo is None and (shape.rgba is not None or shape.texture):
                kind = "textures" if shape.texture else "colors"
                self.report.info(shape.at, f"Gazebo draws URDF {kind} grey; Trundle keeps them", "urdf-colors")
        return visuals

    def _collisions(self, lump: str, part: RobotLink, pose: Pose, first: int) -> list[Collision]:
        collisions: list[Collision] = []
        for number, shape in enumerate(part.collisions, first):
            name = shape_name(lump, shape.name or part.name, "collision", number)
            collision = Collision(
                name=name,
                geometry=self._geometry(shape),
                at=shape.at,
                link_from_collision=pose @ shape.link_from_shape,
            )
            if part.name != lump and not is_lumped_name(name):
                collision = self.tags.with_contact(collision, lump)
            collisions.append(self.tags.with_contact(collision, part.name))
        return collisions

    def _geometry(self, shape: RobotShape) -> Geometry:
        match shape.geometry:
            case RobotBox(size):
                return Box(size)
            case RobotCylinder(radius, length):
                return Cylinder(radius, length)
            case RobotSphere(radius):
                return Sphere(radius)
            case RobotMesh(uri, scale):
                return MeshFile(path=self._path(uri, shape), uri=uri, scale=scale)

    def _material(self, shape: RobotShape) -> Material:
        texture = self._path(shape.texture, shape, "texture") if shape.texture else None
        if shape.rgba is None and texture is None:
            return GREY  # without a material, a mesh keeps its own colors
        r, g, b, _ = shape.rgba or (1.0, 1.0, 1.0, 1.0)
        return Material(ambient=(r, g, b, 1.0), diffuse=(r, g, b, 1.0), texture=texture)

    def _path(self, uri: str, shape: RobotShape, kind: str = "mesh") -> Path | None:
        try:
            return self.context.packages.resolve(uri, folder=self.context.folder, at=shape.at)
        except DescriptionError as error:
            self.report.warn(error.at, f"{error.what}; the {kind} is left out", error.id)
            return None

    def _joint(
        self, joint: RobotJoint, poses: Mapping[str, Pose], followers: Mapping[str, Mimic | None]
    ) -> Joint | None:
        parent, child = self.lump_of[joint.parent], self.lump_of[joint.child]
        if parent == child:
            return None
        if joint.type not in _TYPES:
            self.report.warn(
                joint.at,
                f"joint {joint.name!r}: Gazebo does not support {joint.type} joints; its child is free",
                "unsupported-joint",
            )
            return None
        type_ = _TYPES[joint.type]
        axis = None if type_ is JointType.FIXED else self._axis(joint, poses[joint.child])
        if axis is not None and type_ is not JointType.PLANAR:
            axis = replace(axis, mimic=followers.get(joint.name, _mimic(joint)))
        return Joint(
            name=joint.name,
            type=type_,
            parent=WORLD if joint.parent == WORLD else parent,
            child=child,
            at=joint.at,
            axis=axis,
            sensors=self.tags.sensors(joint.name),
        )

    def _axis(self, joint: RobotJoint, root_from_joint: Pose) -> JointAxis:
        limit = joint.limit
        bounded = limit is not None and joint.type not in ("continuous", "planar")
        lower = limit.lower if limit is not None and bounded and limit.lower > -UNLIMITED else -math.inf
        upper = limit.upper if limit is not None and bounded and limit.upper < UNLIMITED else math.inf
        if lower > upper:
            message = f"joint {joint.name!r}: lower {lower:g} is above upper {upper:g}; swapped, as in Gazebo"
            self.report.warn(joint.at, message, "swapped-limits")
            lower, upper = upper, lower
        return JointAxis(
            direction=root_from_joint.transform_vector(normalized(joint.axis) or (1.0, 0.0, 0.0)),
            lower=lower,
            upper=upper,
            effort=math.inf if limit is None else _bound(limit.effort),
            velocity=math.inf if limit is None else _bound(limit.velocity),
            damping=joint.damping,
            friction=joint.friction,
            spring_reference=self.tags.number(joint.name, "springReference", 0.0),
            spring_stiffness=self.tags.number(joint.name, "springStiffness", 0.0),
        )


def _bound(value: float) -> float:
    """Return an effort or velocity limit; in SDF a negative one is unlimited."""
    return math.inf if value < 0 or value >= UNLIMITED else value


def _mimic(joint: RobotJoint) -> Mimic | None:
    leader = joint.mimic
    return None if leader is None else Mimic(joint=leader.joint, multiplier=leader.multiplier, offset=leader.offset)
