"""Which joint holds which link: trees for the engine, and the joints that close a loop in them.

A file may name links and joints in any order, join links of different models, and let a link hang from two parents.
The engine wants each link to hang from one; a joint that cannot be part of a tree as written may be turned round.
"""

from collections.abc import Mapping, Sequence

from msgspec import Struct
from msgspec.structs import replace

from trundle.diagnostics import DescriptionError, Diagnostics
from trundle.model import Joint, JointAxis, JointType, Link, Model, World, model_from_joint, model_from_links
from trundle.spatial import Pose, Vector3

WORLD = "world"


class LinkNode(Struct, frozen=True, eq=False):
    """A link and where it is."""

    name: str
    """`model::link`"""
    model: int
    link: Link
    fixed: bool
    """As the file says: it is part of the world."""
    at_zero: Pose
    """world_from_link with every joint at zero."""
    at_start: Pose
    """world_from_link with each joint that has no freedom where its limits hold it."""


class JointEdge(Struct, frozen=True, eq=False):
    """A joint as the engine has it: `below` moves against `above`."""

    name: str
    """`model::joint`"""
    joint: Joint
    above: str
    """`model::link` or `world`"""
    below: str
    world_from_joint: Pose
    """With every joint at zero."""
    world_from_axes: Pose
    """The frame that the joint's axes are written in."""
    turned: bool = False
    """Above is the joint's child."""

    @property
    def above_from_below(self) -> Pose | None:
        """Where a fixed joint holds `below`; None: as the two lie with every joint at zero."""
        held = self.joint.parent_from_child
        return held.inverse() if held is not None and self.turned else held

    def direction(self, axis: JointAxis) -> Vector3:
        """The way `below` moves as the joint's position grows, in the world with every joint at zero."""
        x, y, z = self.world_from_axes.direction(axis.direction)
        return (-x, -y, -z) if self.turned else (x, y, z)


class Tree(Struct, frozen=True, eq=False):
    """Every link and joint of a world, in file order: models first, then the joints between models."""

    places: Mapping[str, LinkNode]
    joints: tuple[JointEdge, ...]
    parent_joint: Mapping[str, JointEdge]
    """Link → the joint it hangs from."""
    loops: tuple[JointEdge, ...]
    """Joints between links that are held already."""
    immobile: frozenset[str]
    """Links that cannot move against the world."""

    @classmethod
    def of(cls, world: World, report: Diagnostics) -> "Tree":
        """Find out; what cannot be joined is named and left out.

        Raises:
            DescriptionError: two models, or two links or joints of one, share a name.
        """
        _refuse_twins("model", world.models)
        for model in world.models:
            _refuse_twins("link", model.links)
            _refuse_twins("joint", model.joints)
        places = {place.name: place for i, model in enumerate(world.models) for place in _places(i, model)}
        joints = [hold for model in world.models for hold in _joints_of(model)]
        joints += [_between_models(joint, places) for joint in world.joints if _known(joint, places)]
        for joint in world.joints:
            if not _known(joint, places):
                report.warn(joint.at, f"joint {joint.name!r} joins links that are not there; it is left out")
        held, loops = _grow(joints, places)
        return cls(places, tuple(joints), held, loops, _still(places, held))


def is_rigid(joint: Joint) -> bool:
    """Whether a joint leaves no freedom; one that follows another moves, whatever its limits say."""
    if joint.type is JointType.FIXED:
        return True
    return joint.axis2 is None and joint.axis is not None and joint.axis.is_rigid and joint.axis.mimic is None


def _refuse_twins(kind: str, named: Sequence[Model] | Sequence[Link] | Sequence[Joint]) -> None:
    seen: set[str] = set()
    for one in named:
        if one.name in seen:
            raise DescriptionError(one.at, f"a second {kind} {one.name!r}; names must differ")
        seen.add(one.name)


def _places(index: int, model: Model) -> list[LinkNode]:
    held_at = {j.name: j.axis.lower for j in model.joints if j.axis is not None and is_rigid(j) and j.axis.is_rigid}
    start = model_from_links(model, held_at) if held_at else {}
    return [
        LinkNode(
            name=f"{model.name}::{link.name}",
            model=index,
            link=link,
            fixed=model.static or link.fixed,
            at_zero=model.world_from_model @ link.model_from_link,
            at_start=model.world_from_model @ start.get(link.name, link.model_from_link),
        )
        for link in model.links
    ]


def _joints_of(model: Model) -> list[JointEdge]:
    def full(link: str) -> str:
        return link if link == WORLD else f"{model.name}::{link}"

    return [
        JointEdge(
            name=f"{model.name}::{joint.name}",
            joint=joint,
            above=full(joint.parent),
            below=full(joint.child),
            world_from_joint=model.world_from_model @ model_from_joint(model, joint),
            world_from_axes=model.world_from_model,
        )
        for joint in model.joints
    ]


def _known(joint: Joint, places: Mapping[str, LinkNode]) -> bool:
    return all(link == WORLD or link in places for link in (joint.parent, joint.child))


def _between_models(joint: Joint, places: Mapping[str, LinkNode]) -> JointEdge:
    world_from_child = Pose() if joint.child == WORLD else places[joint.child].at_zero
    joint_pose = world_from_child @ joint.child_from_joint
    return JointEdge(joint.name, joint, joint.parent, joint.child, joint_pose, world_from_axes=Pose())


def _grow(
    joints: list[JointEdge], places: Mapping[str, LinkNode]
) -> tuple[dict[str, JointEdge], tuple[JointEdge, ...]]:
    held: dict[str, JointEdge] = {}

    def can(hold: JointEdge) -> bool:
        if hold.below == WORLD or hold.below in held or places[hold.below].fixed:
            return False
        above = hold.above
        while above in held:
            above = held[above].above
            if above == hold.below:
                return False
        return above != hold.below

    rest: list[JointEdge] = []
    for hold in joints:
        if hold.joint.type is JointType.GEARBOX:
            continue
        if can(hold):
            held[hold.below] = hold
        else:
            rest.append(hold)
    loops: list[JointEdge] = []
    for hold in rest:
        turned = replace(hold, above=hold.below, below=hold.above, turned=True)
        if can(turned):
            held[turned.below] = turned
        elif not all(end == WORLD or places[end].fixed for end in (hold.above, hold.below)):
            loops.append(turned if hold.below == WORLD or places[hold.below].fixed else hold)
    return held, tuple(loops)


def _still(places: Mapping[str, LinkNode], held: Mapping[str, JointEdge]) -> frozenset[str]:
    def moves(name: str) -> bool:
        while not places[name].fixed:
            hold = held.get(name)
            if hold is None or not is_rigid(hold.joint):
                return True
            if hold.above == WORLD:
                return False
            name = hold.above
        return False

    return frozenset(name for name in places if not moves(name))
