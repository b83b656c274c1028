"""Writer of a model as URDF, in which link frames are at their joints.

SDF's link frames are arbitrary; the contents of each link are transformed to URDF's frame.
"""

import math
from collections import Counter

from msgspec.structs import replace

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.robots.model import (
    GREY,
    Box,
    Collision,
    Cylinder,
    Geometry,
    Joint,
    JointType,
    Link,
    MeshFile,
    Model,
    Sensor,
    Sphere,
    Surface,
    Visual,
    model_from_joint,
    with_plain_color,
)
from trundle.spatial import Pose

from ..shape_names import shape_name
from .files import UriOf
from .sdf.environment import add_light
from .sdf.sensor import add_sensor
from .sdf.shapes import add_surface
from .tag import Tag, format_value

_UNLIMITED = 1e16
_TYPES = {
    JointType.REVOLUTE: "revolute",
    JointType.PRISMATIC: "prismatic",
    JointType.FIXED: "fixed",
    JointType.PLANAR: "planar",
}
_WORLD = "world"
_SURFACE = (
    ("mu1", "mu"),
    ("mu2", "mu2"),
    ("fdir1", "fdir1"),
    ("kp", "kp"),
    ("kd", "kd"),
    ("minDepth", "min_depth"),
    ("maxVel", "max_vel"),
)
"""<gazebo> tag → field of Surface."""


def write_urdf(model: Model, *, uri_of: UriOf, report: Diagnostics) -> str:
    """Write a model without nested ones.

    Args:
        model: flattened model.
        uri_of: URIs of meshes.
        report: receives a warning for each part that URDF cannot express.

    Raises:
        DescriptionError: the model is not a tree of URDF's joints.
    """
    return _Writer(model, uri_of, report).robot().document()


class _Writer:
    def __init__(self, model: Model, uri_of: UriOf, report: Diagnostics) -> None:
        self.model = model
        self.uri_of = uri_of
        self.report = report
        self._check()
        self.link_from_frame = {joint.child: joint.child_from_joint for joint in model.joints}
        """Link → URDF's link frame in SDF's."""

    def robot(self) -> Tag:
        """Return <robot>, with <gazebo> blocks for properties beyond URDF."""
        root = Tag("robot", {"name": self.model.name})
        if any(joint.parent == _WORLD for joint in self.model.joints):
            root.add("link", name=_WORLD)
        for link in self.model.links:
            self._add_link(root, link)
        for joint in self.model.joints:
            self._add_joint(root, joint)
        robot_tags = Tag("gazebo")
        robot_tags.add_unless("static", self.model.static, default=False)
        robot_tags.add_unless("self_collide", self.model.self_collide, default=False)
        robot_tags.children += [plugin.node.xml() for plugin in self.model.plugins]
        if robot_tags.children:
            root.children.append(robot_tags)
        return root

    def _check(self) -> None:
        for joint in self.model.joints:
            if joint.type not in _TYPES:
                message = f"joint {joint.name!r}: URDF has no {joint.type.value} joints; --to sdf has"
                raise DescriptionError(joint.at, message, "not-writable-urdf")
            if joint.child == _WORLD:
                raise DescriptionError(
                    joint.at, f"joint {joint.name!r}: in a URDF the world cannot be a child", "not-writable-urdf"
                )
        parent_counts = Counter(joint.child for joint in self.model.joints)
        shared = [name for name, count in parent_counts.items() if count > 1]
        if shared:
            raise DescriptionError(
                self.model.at,
                f"link {shared[0]!r} has {parent_counts[shared[0]]} parents; URDF is a tree",
                "not-writable-urdf",
            )
        roots = [link.name for link in self.model.links if link.name not in parent_counts]
        if any(joint.parent == _WORLD for joint in self.model.joints):
            roots.append(_WORLD)
        if len(roots) != 1:
            names = ", ".join(map(repr, roots)) or "none"
            raise DescriptionError(self.model.at, f"a URDF has one root link; here: {names}", "not-writable-urdf")
        parents = {joint.child: joint.parent for joint in self.model.joints}
        for link in self.model.links:
            name, ancestors = link.name, set[str]()
            while name in parents and name not in ancestors:
                ancestors.add(name)
                name = parents[name]
            if name in ancestors:
                raise DescriptionError(
                    link.at, f"link {link.name!r} is its own ancestor; URDF is a tree", "not-writable-urdf"
                )
        if self.model.world_from_model != Pose():
            self.report.info(
                self.model.at, "a URDF has no pose in the world; the model's pose is left out", "not-in-urdf"
            )

    def _add_link(self, root: Tag, link: Link) -> None:
        frame_from_link = self.link_from_frame.get(link.name, Pose()).inverse()
        tag = root.add("link", name=link.name)
        inertial = tag.add("inertial")
        _add_origin(inertial, frame_from_link @ link.inertial.link_from_com)
        inertial.add("mass", value=format_value(link.inertial.mass))
        names = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
        numbers = (*link.inertial.moments, *link.inertial.products)
        inertial.add("inertia", **{name: format_value(value) for name, value in zip(names, numbers, strict=True)})
        for visual in link.visuals:
            shape = self._add_shape(tag, "visual", visual, frame_from_link @ visual.link_from_visual)
            if shape is not None and visual.material is not GREY:
                material = shape.add("material", name=f"{link.name}_{visual.name}")
                r, g, b, a = with_plain_color(visual.material).diffuse
                material.add("color", rgba=format_value((r, g, b, a * (1.0 - visual.transparency))))
                if visual.material.texture is not None:
                    material.add("texture", filename=self.uri_of(visual.material.texture, ""))
        for collision in link.collisions:
            self._add_shape(tag, "collision", collision, frame_from_link @ collision.link_from_collision)
        self._add_extras(root, link, frame_from_link)

    def _add_shape(self, link: Tag, kind: str, item: Visual | Collision, frame_from_shape: Pose) -> Tag | None:
        """Append <visual> or <collision>; None with a warning for an unsupported shape."""
        geometry = self._geometry(item.geometry)
        if geometry is None:
            shape_kind = type(item.geometry).__name__.lower()
            self.report.warn(item.at, f"{kind} {item.name!r}: URDF has no {shape_kind}; it is left out", "not-in-urdf")
            return None
        shape = link.add(kind, name=item.name)
        _add_origin(shape, frame_from_shape)
        shape.add("geometry").children.append(geometry)
        return shape

    def _geometry(self, geometry: Geometry) -> Tag | None:
        match geometry:
            case Box(size):
                return Tag("box", {"size": format_value(size)})
            case Cylinder(radius, length):
                return Tag("cylinder", {"radius": format_value(radius), "length": format_value(length)})
            case Sphere(radius):
                return Tag("sphere", {"radius": format_value(radius)})
            case MeshFile(submesh=None):
                return Tag(
                    "mesh",
                    {"filename": self.uri_of(geometry.path, geometry.uri), "scale": format_value(geometry.scale)},
                )
            case _:
                return None

    def _add_joint(self, root: Tag, joint: Joint) -> None:
        type_ = _TYPES[joint.type]
        axis = joint.axis
        if joint.type is JointType.REVOLUTE and axis is not None and math.isinf(axis.lower) and math.isinf(axis.upper):
            type_ = "continuous"
        tag = root.add("joint", name=joint.name, type=type_)
        model_from_frame = model_from_joint(self.model, joint)
        if joint.parent == _WORLD:
            model_from_parent = self.model.world_from_model.inverse()
        else:
            link_from_frame = self.link_from_frame.get(joint.parent, Pose())
            model_from_parent = self.model.link(joint.parent).model_from_link @ link_from_frame
        _add_origin(tag, model_from_parent.inverse() @ model_from_frame)
        tag.add("parent", link=joint.parent)
        tag.add("child", link=joint.child)
        if axis is not None and joint.type is not JointType.FIXED:
            tag.add("axis", xyz=format_value(model_from_frame.inverse().transform_vector(axis.direction)))
            bounds = {"effort": format_value(_bounded(axis.effort)), "velocity": format_value(_bounded(axis.velocity))}
            if type_ != "continuous":
                bounds |= {"lower": format_value(_bounded(axis.lower)), "upper": format_value(_bounded(axis.upper))}
            tag.add("limit", **bounds)
            if axis.damping or axis.friction:
                tag.add("dynamics", damping=format_value(axis.damping), friction=format_value(axis.friction))
            if axis.mimic is not None:
                offset = axis.mimic.offset - axis.mimic.multiplier * axis.mimic.reference
                multiplier = format_value(axis.mimic.multiplier)
                tag.add("mimic", joint=axis.mimic.joint, multiplier=multiplier, offset=format_value(offset))
        extra = Tag("gazebo", {"reference": joint.name})
        if joint.type is JointType.FIXED:
            extra.add("preserveFixedJoint", True)
        elif axis is not None:
            extra.add_unless("springReference", axis.spring_reference, default=0.0)
            extra.add_unless("springStiffness", axis.spring_stiffness, default=0.0)
        for sensor in joint.sensors:
            add_sensor(extra, sensor, self.report)
        if extra.children:
            root.children.append(extra)

    def _add_extras(self, root: Tag, link: Link, frame_from_link: Pose) -> None:
        """Append the <gazebo> block: friction, gravity, sensors."""
        extra = Tag("gazebo", {"reference": link.name})
        surfaces = {collision.surface for collision in link.collisions}
        if len(surfaces) > 1:
            self.report.warn(
                link.at, f"link {link.name!r}: a URDF has one surface per link; the first one is written", "not-in-urdf"
            )
        _add_surface(extra, link.collisions[0].surface if link.collisions else Surface())
        extra.add_unless("turnGravityOff", not link.gravity, default=False)
        extra.add_unless("selfCollide", link.self_collide, default=None)
        plugins = dict.fromkeys(plugin for visual in link.visuals for plugin in visual.plugins)
        if plugins:
            extra.add("visual").children += [plugin.node.xml() for plugin in plugins]
        if any(set(visual.plugins) != plugins.keys() for visual in link.visuals):
            self.report.warn(
                link.at, f"link {link.name!r}: in a URDF all its visuals get the plugins of any", "not-in-urdf"
            )
        for sensor in link.sensors:
            moved = replace(sensor, link_from_sensor=frame_from_link @ sensor.link_from_sensor)
            add_sensor(extra, self._with_contacts(moved, link), self.report)
        for light in link.lights:
            add_light(extra, replace(light, world_from_light=frame_from_link @ light.world_from_light))
        if extra.children:
            root.children.append(extra)

    def _with_contacts(self, sensor: Sensor, link: Link) -> Sensor:
        """Return a contact sensor with the names that conversion of the URDF gives its collisions."""
        if not sensor.contact_collisions:
            return sensor
        written = [collision.name for collision in link.collisions if self._geometry(collision.geometry) is not None]
        names = {name: shape_name(link.name, name, "collision", number) for number, name in enumerate(written)}
        return replace(sensor, contact_collisions=tuple(names.get(name, name) for name in sensor.contact_collisions))


def _add_surface(extra: Tag, surface: Surface) -> None:
    """Append friction and compliance; as SDF if the surface has more than URDF's tags express."""
    default = Surface()
    of_urdf = {name: getattr(surface, name) for _, name in _SURFACE}
    if surface != replace(default, **of_urdf):
        add_surface(extra.add("collision"), surface)
        return
    for tag, name in _SURFACE:
        extra.add_unless(tag, of_urdf[name], default=getattr(default, name))


def _add_origin(home: Tag, pose: Pose) -> None:
    x, y, z, *rpy = pose.as_list()
    if pose != Pose():
        home.add("origin", xyz=format_value((x, y, z)), rpy=format_value(rpy))


def _bounded(value: float) -> float:
    """Return a finite limit; 1e16 means unlimited, as in SDF."""
    return value if math.isfinite(value) else math.copysign(_UNLIMITED, value)
