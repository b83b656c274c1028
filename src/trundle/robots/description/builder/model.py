"""Builder of a model: links and joints."""

from pathlib import Path
from typing import TYPE_CHECKING
from xml.sax.saxutils import escape, quoteattr

from msgspec.structs import replace

from trundle.base.arguments import pose_of, vector_of
from trundle.base.diagnostics import UsageError, no_such
from trundle.base.documented import documented
from trundle.base.xmlnode import parse_xml
from trundle.robots import model
from trundle.robots.model import JointAxis, PluginTag
from trundle.spatial import Pose

from .joint import Joint
from .link import Link
from .names import BUILT, check_name
from .shapes import Shape, ShapeAdder
from .writing import save, sdf_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from trundle.base.arguments import PoseLike

_ORIGIN = Pose()


@documented("add_link add_joint add_plugin add_box add_sphere add_cylinder add_capsule add_mesh to_sdf save")
class Model(ShapeAdder[Link]):
    """Links joined by joints; a shape added to the model becomes a link at the shape's pose."""

    __module__ = "trundle"

    def __init__(
        self, name: str, *, pose: "PoseLike" = _ORIGIN, static: bool = False, self_collide: bool = False
    ) -> None:
        """Create an empty model.

        Args:
            name: model's name.
            pose: pose in the world.
            static: True if the model never moves.
            self_collide: True if its links collide with one another.
        """
        check_name(name, (), "a model")
        self.name = name
        self.pose = pose_of(pose)
        self._static, self._self_collide = static, self_collide
        self._links: list[Link] = []
        self._joints: list[Joint] = []
        self._plugins: list[PluginTag] = []

    def add_link(self, name: str, *, pose: "PoseLike" = _ORIGIN) -> Link:
        """Add an empty link.

        Args:
            name: link's name.
            pose: pose in the model's frame [m, rad]: `Pose`, or 3, 6 or 7 numbers.

        Raises:
            UsageError: duplicate name, or it is no pose; the message lists the names in use.
        """
        check_name(name, [*self._links, *self._joints], f"model {self.name!r}")
        self._links.append(Link(name, pose_of(pose)))
        return self._links[-1]

    def add_shape(self, shape: Shape) -> Link:
        """Add a shape as the only shape of a new link."""
        return self.add_link(shape.name, pose=shape.pose).add_shape(replace(shape, pose=_ORIGIN))

    def add_joint(
        self,
        name: str,
        type: str,
        parent: Link | str,
        child: Link | str,
        *,
        pose: "PoseLike" = _ORIGIN,
        axis: "ArrayLike | JointAxis" = (0.0, 0.0, 1.0),
        axis2: "ArrayLike | JointAxis | None" = None,
    ) -> Joint:
        """Connect two links, or a link and the "world".

        Args:
            name: joint's name.
            type: SDF's: revolute, prismatic, fixed, ball, universal, screw or revolute2.
            parent: link or its name, or "world".
            child: link or its name.
            pose: joint frame in the child's frame: `Pose`, or 3, 6 or 7 numbers.
            axis: direction in the joint's frame (3), without limits, or a `JointAxis`.
            axis2: second axis of universal and revolute2 joints.

        Raises:
            UsageError: unknown type or link, or a duplicate name; the message lists the valid ones.
        """
        check_name(name, [*self._links, *self._joints], f"model {self.name!r}")
        joint = Joint(
            name,
            type,
            self._link_name(parent, name, ("world",)),
            self._link_name(child, name, ()),
            pose=pose_of(pose),
            axes=(_axis(axis, "axis"), _axis(axis2, "axis2")),
        )
        self._joints.append(joint)
        return joint

    def add_plugin(self, name: str, filename: str, **parameters: str | float) -> None:
        """Add a plugin to the model, as loaded by `trundle.load(…, plugins=True)`.

        Args:
            name: plugin's name.
            filename: Gazebo's library or a Python file.
            parameters: its SDF elements.

        Raises:
            DescriptionError: a parameter's name is no name of an XML element.
        """
        inner = "".join(f"<{key}>{escape(str(value))}</{key}>" for key, value in parameters.items())
        text = f"<plugin name={quoteattr(name)} filename={quoteattr(filename)}>{inner}</plugin>"
        node = parse_xml(text, name=BUILT.file)
        self._plugins.append(PluginTag(name=name, filename=filename, at=BUILT, node=node))

    def _link_name(self, link: Link | str, joint: str, others: tuple[str, ...]) -> str:
        name = link if isinstance(link, str) else link.name
        names = [*(existing.name for existing in self._links), *others]
        if name not in names:
            raise UsageError(no_such(f"model {self.name!r}, joint {joint!r}: no link", name, names))
        return name

    def description(self) -> model.Model:
        """Return the model as a reader would."""
        poses = {link.name: link.pose for link in self._links}
        return model.Model(
            name=self.name,
            at=BUILT,
            world_from_model=self.pose,
            static=self._static,
            self_collide=self._self_collide,
            links=tuple(link.description() for link in self._links),
            joints=tuple(joint.description(poses[joint.child]) for joint in self._joints),
            plugins=tuple(self._plugins),
            canonical_link=self._links[0].name if self._links else None,
        )

    def to_sdf(self) -> str:
        """Return the model as an SDF document."""
        return sdf_of(model.World(name=self.name, at=BUILT, models=(self.description(),)), is_world=False)

    def save(self, file: str | Path) -> None:
        """Write the model as an SDF file.

        Raises:
            UsageError: it cannot be written.
        """
        save(self.to_sdf(), file)

    def __repr__(self) -> str:
        links, joints = (", ".join(repr(part.name) for part in group) for group in (self._links, self._joints))
        return f"<Model {self.name!r}; links: {links or 'none'}; joints: {joints or 'none'}>"


def _axis(axis: "ArrayLike | JointAxis | None", name: str) -> JointAxis | None:
    return axis if axis is None or isinstance(axis, JointAxis) else JointAxis(direction=vector_of(axis, name))
