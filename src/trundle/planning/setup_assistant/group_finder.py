"""Groups of a robot, found in its tree of joints: arms, and what they carry."""

import re
from collections.abc import Iterator

from msgspec import Struct

from trundle.planning.robot_model import JointModel, RobotModel

_MIN_JOINTS = 3
"""Fewest active joints of an arm."""
_GRIPPING = re.compile(r"grip|finger|jaw|claw|knuckle|thumb|suction|vacuum", re.IGNORECASE)
_HANDS = re.compile(r"grip|hand|palm|robotiq|wsg|\bee\b", re.IGNORECASE)
_TIPS = re.compile(r"tool0|tcp|flange|ee_|_ee|end_effector|grasp|grip_center|tool|link_?8|tip", re.IGNORECASE)
_SIDES = re.compile(r"(?:^|_)(left|right|front|rear|upper|lower|[lr])(?=_)", re.IGNORECASE)


_WORDS = {"l": "left", "r": "right"}
WORLD = "world"


class FoundGripper(Struct, frozen=True, kw_only=True):
    """Joints at the end of an arm."""

    name: str
    parent_link: str
    """Link of the arm that carries it."""
    links: tuple[str, ...]
    """Links that are part of it without a joint of its own that moves."""
    joints: tuple[str, ...]
    """Joints that move, mimic joints too."""


class FoundArm(Struct, frozen=True, kw_only=True):
    """Chain of joints with at most one gripper."""

    name: str
    base_link: str
    tip_link: str
    joints: tuple[str, ...]
    """Active joints."""
    gripper: FoundGripper | None = None


class FoundGroups(Struct, frozen=True, kw_only=True):
    """Arms of a robot, and joints that belong to none."""

    arms: tuple[FoundArm, ...]
    wheels: tuple[str, ...]
    """Joints that turn without end outside all arms."""


def find_groups(model: RobotModel) -> FoundGroups:
    """Find arms: chains of three or more joints that end in a tip, or where a gripper branches off."""
    finder = _Finder(model)
    chains = list(finder.chains())
    arms = [finder.arm(chain, chains) for chain in chains]
    used = {name for arm in arms for name in (*arm.joints, *(arm.gripper.joints if arm.gripper else ()))}
    wheels = tuple(joint.name for joint in model.joints if joint.type == "continuous" and joint.name not in used)
    return FoundGroups(arms=tuple(arms), wheels=wheels)


class _Finder:
    def __init__(self, model: RobotModel) -> None:
        self._children: dict[str, list[JointModel]] = {}
        for joint in model.joints[1:]:
            self._children.setdefault(joint.parent_link, []).append(joint)
        self._root = model.root_link
        self._moving: dict[str, int] = {}
        """Link → number of moving joints below it."""
        for joint in reversed(model.joints):
            below = self._moving.setdefault(joint.child_link, 0)
            if joint.parent_link:
                total = self._moving.get(joint.parent_link, 0)
                self._moving[joint.parent_link] = total + below + bool(joint.variables)

    def _branches(self, link: str) -> list[JointModel]:
        """Return the joints of a link that move, or below which something moves."""
        return [
            joint for joint in self._children.get(link, []) if joint.variables or self._moving[joint.child_link] > 0
        ]

    def chains(self) -> Iterator[list[JointModel]]:
        """Yield the chains of an arm's length, from the root on; what branches off an arm's end is its gripper."""
        pending: list[tuple[str, list[JointModel]]] = [(self._root, [])]
        while pending:
            link, chain = pending.pop()
            branches = self._branches(link)
            while len(branches) == 1 and not self._is_gripping(branches[0], chain):
                chain = [*chain, branches[0]]
                link = branches[0].child_link
                branches = self._branches(link)
            if _active(chain) >= _MIN_JOINTS and not any(self._is_long(joint) for joint in branches):
                yield chain
            else:  # a torso, a base: the arms begin after it
                pending += [(joint.child_link, [joint]) for joint in reversed(branches)]

    def _is_gripping(self, joint: JointModel, chain: list[JointModel]) -> bool:
        names = f"{joint.name} {joint.child_link}"
        is_last = self._moving[joint.child_link] == 0
        return is_last and bool(joint.variables) and _active(chain) >= _MIN_JOINTS and bool(_GRIPPING.search(names))

    def _is_long(self, joint: JointModel) -> bool:
        """Return True if an arm's number of joints follows one another below a joint."""
        depth: dict[str, int] = {joint.child_link: int(joint.is_active)}
        pending = [joint.child_link]
        while pending:
            link = pending.pop()
            if depth[link] >= _MIN_JOINTS:
                return True
            for child in self._branches(link):
                depth[child.child_link] = depth[link] + child.is_active
                pending.append(child.child_link)
        return False

    def arm(self, chain: list[JointModel], chains: list[list[JointModel]]) -> FoundArm:
        """Return the arm of a chain, with its tip and gripper."""
        base = self._base(chain)
        chain = self._without_fixed_start(chain)
        side = _side(chain) if len(chains) > 1 else ""
        if len(chains) > 1 and not side:
            side = f"{next(i for i, other in enumerate(chains, 1) if other[-1] is chain[-1])}_"
        end = chain[-1].child_link
        active = tuple(joint.name for joint in chain if joint.is_active)
        branches = self._branches(end)
        if not branches:
            return FoundArm(name=f"{side}arm", base_link=base, tip_link=self._tip(end), joints=active)
        palms: list[str] = []
        parent = end
        if chain[-1].type == "fixed":  # the palm is fixed to the last joint, perhaps by a flange
            while chain and chain[-1].type == "fixed" and (not palms or _HANDS.search(chain[-1].child_link)):
                palms.insert(0, chain[-1].child_link)
                parent = chain[-1].parent_link
                chain = chain[:-1]
        below = self._below(branches)
        gripper = FoundGripper(
            name=f"{side}gripper",
            parent_link=parent,
            links=(*palms, *(joint.child_link for joint in below if joint.type == "fixed")),
            joints=tuple(joint.name for joint in below if joint.variables),
        )
        return FoundArm(
            name=f"{side}arm", base_link=base, tip_link=self._tip_beside(parent), joints=active, gripper=gripper
        )

    def _base(self, chain: list[JointModel]) -> str:
        """Return the link that holds the first joint that moves, or one to which it is fixed, but not the world."""
        base = self._without_fixed_start(chain)[0].parent_link
        for joint in reversed(chain[: next(i for i, joint in enumerate(chain) if joint.variables)]):
            if joint.parent_link == WORLD or len(self._branches(joint.parent_link)) > 1:
                break
            base = joint.parent_link
        return base

    def _without_fixed_start(self, chain: list[JointModel]) -> list[JointModel]:
        first = next(i for i, joint in enumerate(chain) if joint.variables)
        return chain[first:]

    def _tip_beside(self, link: str) -> str:
        """Return a link between the fingers, fixed to the one that carries them; without one, that one."""
        named = [
            joint.child_link
            for joint in self._children.get(link, [])
            if joint.type == "fixed" and _TIPS.search(joint.child_link) and not self._children.get(joint.child_link)
        ]
        return named[0] if named else link

    def _tip(self, link: str) -> str:
        """Return the link at the end of the fixed joints below; of several, the one named as a tool's."""
        while children := self._children.get(link):
            named = [joint for joint in children if _TIPS.search(joint.child_link)]
            if len(children) > 1 and not named:
                break
            link = (named or children)[0].child_link
        return link

    def _below(self, joints: list[JointModel]) -> list[JointModel]:
        found: list[JointModel] = []
        pending = list(reversed(joints))
        while pending:
            joint = pending.pop()
            found.append(joint)
            pending += reversed(self._children.get(joint.child_link, []))
        return found


def _active(chain: list[JointModel]) -> int:
    return sum(joint.is_active for joint in chain)


def _side(chain: list[JointModel]) -> str:
    """Return `left_` where all joints of a chain say so."""
    words = [{word.lower() for word in _SIDES.findall(f"_{joint.name}_")} for joint in chain if joint.variables]
    for word in sorted(words[0]):
        if all(word in others for others in words):
            return f"{_WORDS.get(word, word)}_"
    return ""
