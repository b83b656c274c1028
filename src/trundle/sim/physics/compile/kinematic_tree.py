"""Kinematic trees of links and joints, and the joints that close loops in them.

Files name links and joints in any order, join links of different models, and give a link two parents. The engine needs
one parent per link; a joint that does not fit a tree as written may be reversed.
"""

from collections.abc import Mapping, Sequence

from msgspec import Struct
from msgspec.structs import replace

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.robots.model import Joint, JointAxis, JointType, Link, Model, World, model_from_joint, model_from_links
from trundle.spatial import Pose, Vector3

WORLD = "world"


class LinkNode(Struct, frozen=True, eq=False):
    """Link and its pose."""

    name: str
    """`model::link`"""
    model: int
    link: Link
    fixed: bool
    """True if the file makes it part of the world."""
    world_from_link_at_zero: Pose
    """world_from_link with every joint at zero."""
    world_from_link: Pose
    """world_from_link with each rigid joint at its limit."""


class JointEdge(Struct, frozen=True, eq=False):
    """Joint between a parent and a child link of the tree."""

    name: str
    """`model::joint`"""
    joint: Joint
    parent: str
    """`model::link` or `world`"""
    child: str
    world_from_joint: Pose
    """Joint frame with every joint at zero."""
    world_from_axes: Pose
    """Frame of the joint's axes."""
    is_reversed: bool = False
    """True if parent and child are swapped relative to the file."""

    @property
    def parent_from_child(self) -> Pose | None:
        """Pose of the child in the parent's frame held by a fixed joint; None: the poses with every joint at zero."""
        pose = self.joint.parent_from_child
        return pose.inverse() if pose is not None and self.is_reversed else pose

    def direction(self, axis: JointAxis) -> Vector3:
        """Return the axis along which the child moves for a growing joint position, in the world with every joint at
        zero.
        """
        x, y, z = self.world_from_axes.transform_vector(axis.direction)
        return (-x, -y, -z) if self.is_reversed else (x, y, z)


class KinematicTree(Struct, frozen=True, eq=False):
    """Links and joints of a world in file order: models first, then joints between models."""

    links: Mapping[str, LinkNode]
    joints: tuple[JointEdge, ...]
    parent_joint: Mapping[str, JointEdge]
    """Link → its parent joint."""
    loops: tuple[JointEdge, ...]
    """Joints whose child already has a parent joint."""
    immobile: frozenset[str]
    """Links that cannot move relative to the world."""

    @classmethod
    def from_world(cls, world: World, report: Diagnostics) -> "KinematicTree":
        """Build the trees of a world; joints with unknown links are dropped with a warning.

        Raises:
            DescriptionError: two models, or two links or joints of one, share a name.
        """
        _refuse_duplicates("model", world.models)
        for model in world.models:
            _refuse_duplicates("link", model.links)
            _refuse_duplicates("joint", model.joints)
        nodes = {node.name: node for i, model in enumerate(world.models) for node in _link_nodes(i, model)}
        joints = [edge for model in world.models for edge in _joint_edges(model)]
        joints += [_joint_between_models(joint, nodes) for joint in world.joints if _has_known_links(joint, nodes)]
        for joint in world.joints:
            if not _has_known_links(joint, nodes):
                report.warn(
                    joint.at, f"joint {joint.name!r} connects links that do not exist; it is left out", "missing-link"
                )
        parent_joint, loops = _spanning_tree(joints, nodes)
        return cls(nodes, tuple(joints), parent_joint, loops, _immobile_links(nodes, parent_joint))


def is_rigid(joint: Joint) -> bool:
    """True if a joint has no freedom; a mimic joint moves even with lower == upper."""
    if joint.type is JointType.FIXED:
        return True
    return joint.axis2 is None and joint.axis is not None and joint.axis.is_rigid and joint.axis.mimic is None


def _refuse_duplicates(kind: str, named: Sequence[Model] | Sequence[Link] | Sequence[Joint]) -> None:
    names: set[str] = set()
    for item in named:
        if item.name in names:
            raise DescriptionError(item.at, f"a second {kind} {item.name!r}; names must differ", "duplicate-name")
        names.add(item.name)


def _link_nodes(index: int, model: Model) -> list[LinkNode]:
    rigid_positions = {
        j.name: j.axis.lower for j in model.joints if j.axis is not None and is_rigid(j) and j.axis.is_rigid
    }
    start = model_from_links(model, rigid_positions) if rigid_positions else {}
    return [
        LinkNode(
            name=f"{model.name}::{link.name}",
            model=index,
            link=link,
            fixed=model.static or link.fixed,
            world_from_link_at_zero=model.world_from_model @ link.model_from_link,
            world_from_link=model.world_from_model @ start.get(link.name, link.model_from_link),
        )
        for link in model.links
    ]


def _joint_edges(model: Model) -> list[JointEdge]:
    def full(link: str) -> str:
        return link if link == WORLD else f"{model.name}::{link}"

    return [
        JointEdge(
            name=f"{model.name}::{joint.name}",
            joint=joint,
            parent=full(joint.parent),
            child=full(joint.child),
            world_from_joint=model.world_from_model @ model_from_joint(model, joint),
            world_from_axes=model.world_from_model,
        )
        for joint in model.joints
    ]


def _has_known_links(joint: Joint, nodes: Mapping[str, LinkNode]) -> bool:
    return all(link == WORLD or link in nodes for link in (joint.parent, joint.child))


def _joint_between_models(joint: Joint, nodes: Mapping[str, LinkNode]) -> JointEdge:
    world_from_child = Pose() if joint.child == WORLD else nodes[joint.child].world_from_link_at_zero
    joint_pose = world_from_child @ joint.child_from_joint
    return JointEdge(joint.name, joint, joint.parent, joint.child, joint_pose, world_from_axes=Pose())


def _spanning_tree(
    joints: list[JointEdge], nodes: Mapping[str, LinkNode]
) -> tuple[dict[str, JointEdge], tuple[JointEdge, ...]]:
    parent_joint: dict[str, JointEdge] = {}

    def can_add(edge: JointEdge) -> bool:
        if edge.child == WORLD or edge.child in parent_joint or nodes[edge.child].fixed:
            return False
        ancestor = edge.parent
        while ancestor in parent_joint:
            ancestor = parent_joint[ancestor].parent
            if ancestor == edge.child:
                return False
        return ancestor != edge.child

    rest: list[JointEdge] = []
    for edge in joints:
        if edge.joint.type is JointType.GEARBOX:
            continue
        if can_add(edge):
            parent_joint[edge.child] = edge
        else:
            rest.append(edge)
    loops: list[JointEdge] = []
    for edge in rest:
        swapped = replace(edge, parent=edge.child, child=edge.parent, is_reversed=True)
        if can_add(swapped):
            parent_joint[swapped.child] = swapped
        elif not all(end == WORLD or nodes[end].fixed for end in (edge.parent, edge.child)):
            loops.append(swapped if edge.child == WORLD or nodes[edge.child].fixed else edge)
    return parent_joint, tuple(loops)


def _immobile_links(nodes: Mapping[str, LinkNode], parent_joint: Mapping[str, JointEdge]) -> frozenset[str]:
    def moves(name: str) -> bool:
        while not nodes[name].fixed:
            edge = parent_joint.get(name)
            if edge is None or not is_rigid(edge.joint):
                return True
            if edge.parent == WORLD:
                return False
            name = edge.parent
        return False

    return frozenset(name for name in nodes if not moves(name))
