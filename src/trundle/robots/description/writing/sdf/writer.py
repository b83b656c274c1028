"""Writer of worlds and models as SDF 1.11, with every pose and default explicit.

A pose is relative to its parent element, an axis to the model frame, so the result does not depend on its context.
"""

import math

from trundle.base.diagnostics import Diagnostics
from trundle.robots.model import Actor, Frame, Joint, JointAxis, JointType, Link, Model, World, model_from_joint

from ..files import UriOf
from ..tag import Tag
from .environment import add_environment, add_light
from .sensor import add_sensor
from .shapes import add_collision, add_visual
from .world_elements import add_actor, add_road, add_state

_VERSION = "1.11"
_SCOPED_NAMES = "1.7"
"""Last version that allows `::` in names, as in flattened models of that time."""


def write_sdf(world: World, *, is_world: bool, uri_of: UriOf, report: Diagnostics) -> str:
    """Write a world, or the models and lights alone.

    Args:
        world: world to write.
        is_world: write <world>, not only its contents.
        uri_of: URIs of meshes, terrains and textures.
        report: receives warnings of settings that the model does not hold.
    """
    scoped = any(_has_scoped_names(model) for model in world.models)
    root = Tag("sdf", {"version": _SCOPED_NAMES if scoped else _VERSION})
    writer = _Writer(uri_of, report)
    home = root.add("world", name=world.name) if is_world else root
    if is_world:
        add_environment(home, world)
    for light in world.lights:
        add_light(home, light)
    for model in world.models:
        writer.add_model(home, model)
    if is_world:
        whole = Model(name=world.name, at=world.at, models=world.models)
        for frame in world.frames:
            _add_frame(home, frame, "world")
        for joint in world.joints:
            writer.add_joint(home, joint, joint.name, whole, "world")
        for road in world.roads:
            add_road(home, road, uri_of)
        home.children += [plugin.node.xml() for plugin in world.plugins]
        add_state(home, world)
    for actor in world.actors:
        writer.add_actor(home, actor)
    return root.document()


class _Writer:
    def __init__(self, uri_of: UriOf, report: Diagnostics) -> None:
        self.uri_of = uri_of
        self.report = report

    def add_model(self, home: Tag, model: Model) -> None:
        """Append <model>, nested ones inside."""
        tag = home.add("model", name=model.name)
        if model.canonical_link is not None:
            tag.attributes = {**tag.attributes, "canonical_link": model.canonical_link}
        tag.add_pose(model.world_from_model)
        tag.add_unless("static", model.static, default=False)
        tag.add_unless("self_collide", model.self_collide, default=False)
        tag.add_unless("allow_auto_disable", model.allow_auto_disable, default=True)
        tag.add_unless("enable_wind", model.enable_wind, default=False)
        for link in model.links:
            self._add_link(tag, link)
        for nested in model.models:
            self.add_model(tag, nested)
        for frame in model.frames:
            _add_frame(tag, frame, "__model__")
        link_names = {link.name for link in model.links}
        for joint in model.joints:
            # Before SDF 1.7 a joint could have a link's name.
            name = f"{joint.name}_joint" if joint.name in link_names else joint.name
            self.add_joint(tag, joint, name, model, "__model__")
        tag.children += [plugin.node.xml() for plugin in model.plugins]

    def add_actor(self, home: Tag, actor: Actor) -> None:
        """Append <actor>."""
        tag = add_actor(home, actor, self.uri_of)
        as_model = Model(name=actor.name, at=actor.at, links=actor.links)
        for link in actor.links:
            self._add_link(tag, link)
        for joint in actor.joints:
            self.add_joint(tag, joint, joint.name, as_model, "__model__")
        tag.children += [plugin.node.xml() for plugin in actor.plugins]

    def _add_link(self, home: Tag, link: Link) -> None:
        tag = home.add("link", name=link.name)
        tag.add_pose(link.model_from_link)
        inertial = tag.add("inertial")
        inertial.add_pose(link.inertial.link_from_com)
        inertial.add("mass", link.inertial.mass)
        inertia = inertial.add("inertia")
        for name, value in zip(("ixx", "iyy", "izz"), link.inertial.moments, strict=True):
            inertia.add(name, value)
        for name, value in zip(("ixy", "ixz", "iyz"), link.inertial.products, strict=True):
            inertia.add(name, value)
        tag.add_unless("gravity", link.gravity, default=True)
        tag.add_unless("self_collide", link.self_collide, default=None)
        tag.add_unless("kinematic", link.kinematic, default=False)
        tag.add_unless("enable_wind", link.enable_wind, default=None)
        if (link.linear_decay, link.angular_decay) != (0.0, 0.0):
            decay = tag.add("velocity_decay")
            decay.add("linear", link.linear_decay)
            decay.add("angular", link.angular_decay)
        for visual in link.visuals:
            add_visual(tag, visual, self.uri_of)
            if visual.material.texture_scale != (1.0, 1.0):
                self.report.warn(visual.at, f"visual {visual.name!r}: SDF has no texture scale", "not-in-sdf")
        for collision in link.collisions:
            add_collision(tag, collision, self.uri_of)
        for sensor in link.sensors:
            add_sensor(tag, sensor, self.report)
        for light in link.lights:
            add_light(tag, light)

    def add_joint(self, home: Tag, joint: Joint, name: str, model: Model, root: str) -> None:
        """Append <joint>.

        Args:
            home: element of the model or world.
            joint: joint to write.
            name: name in the file.
            model: model with its links.
            root: frame of `home`.
        """
        if joint.type is JointType.PLANAR:
            self.report.warn(joint.at, f"joint {name!r}: SDF has no planar joints; its child is free", "not-in-sdf")
            return
        tag = home.add("joint", name=name, type=joint.type.value)
        by_link = joint.child_frame is None and joint.child != "world"
        tag.add_pose(joint.child_from_joint if by_link else model_from_joint(model, joint), None if by_link else root)
        tag.add("parent", joint.parent_frame or joint.parent)
        tag.add("child", joint.child_frame or joint.child)
        if joint.child == "world" and root != "world":
            self.report.warn(
                joint.at, f"joint {name!r} has the world as its child, which SDF 1.8 and later refuse", "not-in-sdf"
            )
        for axis_tag, axis in (("axis", joint.axis), ("axis2", joint.axis2)):
            if axis is not None:
                _add_axis(tag.add(axis_tag), axis, root)
        if joint.type is JointType.SCREW:
            turn = ("screw_thread_pitch", -math.tau / joint.thread_pitch) if joint.thread_pitch else ("thread_pitch", 0)
            tag.add(*turn)
        tag.add_unless("gearbox_ratio", joint.gearbox_ratio, default=1.0)
        tag.add_unless("gearbox_reference_body", joint.gearbox_reference_body, default=None)
        for sensor in joint.sensors:
            add_sensor(tag, sensor, self.report)


def _add_frame(home: Tag, frame: Frame, root: str) -> None:
    tag = home.add("frame", name=frame.name)
    if frame.attached_to != root:
        tag.attributes = {**tag.attributes, "attached_to": frame.attached_to}
    tag.add_pose(frame.model_from_frame, root)


def _add_axis(tag: Tag, axis: JointAxis, root: str) -> None:
    tag.add("xyz", axis.direction, expressed_in=root)
    tag.add_unless("initial_position", axis.initial_position, default=0.0)
    limit = tag.add_optional("limit")
    limit.add_unless("lower", axis.lower, default=-math.inf)
    limit.add_unless("upper", axis.upper, default=math.inf)
    limit.add_unless("effort", axis.effort, default=math.inf)
    limit.add_unless("velocity", axis.velocity, default=math.inf)
    default = JointAxis(direction=axis.direction)
    limit.add_unless("stiffness", axis.stop_stiffness, default=default.stop_stiffness)
    limit.add_unless("dissipation", axis.stop_dissipation, default=default.stop_dissipation)
    dynamics = tag.add_optional("dynamics")
    for name in ("damping", "friction", "spring_reference", "spring_stiffness"):
        dynamics.add_unless(name, getattr(axis, name), default=0.0)
    if axis.mimic is not None:
        mimic = tag.add("mimic", joint=axis.mimic.joint, axis="axis2" if axis.mimic.axis else "axis")
        mimic.add("multiplier", axis.mimic.multiplier)
        mimic.add("offset", axis.mimic.offset)
        mimic.add("reference", axis.mimic.reference)


def _has_scoped_names(model: Model) -> bool:
    names = (part.name for group in (model.links, model.joints, model.frames, model.models) for part in group)
    return any("::" in name for name in names) or any(map(_has_scoped_names, model.models))
