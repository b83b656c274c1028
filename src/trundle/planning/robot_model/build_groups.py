"""Groups of a model, of an SRDF."""

from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise

from trundle.base.diagnostics import Diagnostics, no_such

from .groups import EndEffector, JointModelGroup
from .joint_models import JointModel
from .srdf import Srdf, SrdfChain, SrdfEndEffector, SrdfGroup, SrdfState


class GroupBuilder:
    """Builds groups; what does not fit the model is left out with a warning."""

    def __init__(self, joints: Sequence[JointModel], srdf: Srdf, report: Diagnostics) -> None:
        self._joints = joints
        self._srdf = srdf
        self._report = report
        self._order = {joint.name: index for index, joint in enumerate(joints)}
        self._holder = {joint.child_link: joint for joint in joints}

    def build(self) -> tuple[dict[str, JointModelGroup], dict[str, EndEffector]]:
        """Return groups and end effectors by name."""
        members = self._members()
        end_effectors = self._end_effectors(members)
        groups = {name: self._group(name, joints, members, end_effectors) for name, joints in members.items()}
        for state in self._srdf.states:
            self._add_state(state, groups)
        return groups, end_effectors

    def _members(self) -> dict[str, list[JointModel]]:
        """Return the joints of each group, parents first."""
        written: dict[str, SrdfGroup] = {}
        for group in self._srdf.groups:
            if group.name in written:
                first = written[group.name].at
                self._report.warn(
                    group.at, f"a second group {group.name!r}; the first, at {first}, is used", "duplicate-name"
                )
            else:
                written[group.name] = group
        members: dict[str, list[JointModel]] = {}
        for name in _leaves_first(written, self._report):
            group = written[name]
            names = self._own_joints(group)
            for subgroup in group.subgroups:
                names.update(joint.name for joint in members.get(subgroup, []))
            if names:
                members[name] = [self._joints[index] for index in sorted(self._order[name] for name in names)]
            else:
                self._report.warn(group.at, f"group {name!r} has no joints; it is left out", "incomplete-element")
        return {name: members[name] for name in written if name in members}

    def _own_joints(self, group: SrdfGroup) -> set[str]:
        names: set[str] = set()
        for joint in group.joints:
            if joint in self._order:
                names.add(joint)
            else:
                self._leave_out(group, no_such("no joint", joint, self._order))
        for link in group.links:
            if link in self._holder:
                names.add(self._holder[link].name)
            else:
                self._leave_out(group, no_such("no link", link, self._holder))
        for chain in group.chains:
            names.update(self._chain(group, chain))
        return names

    def _leave_out(self, group: SrdfGroup, fault: str) -> None:
        self._report.warn(group.at, f"group {group.name!r}: {fault}; it is left out", "missing-link")

    def _chain(self, group: SrdfGroup, chain: SrdfChain) -> set[str]:
        """Return the joints from the base to the tip; by their common ancestor if the tip is not below the base."""
        for link in (chain.base_link, chain.tip_link):
            if link not in self._holder:
                self._leave_out(group, no_such("no link", link, self._holder))
                return set()
        above_base, above_tip = self._above(chain.base_link), self._above(chain.tip_link)
        common = set(above_base) & set(above_tip)
        names = {joint for joint in (*above_base, *above_tip) if joint not in common}
        if not names:
            fault = f"the chain from {chain.base_link!r} to {chain.tip_link!r} has no joint"
            self._report.warn(group.at, f"group {group.name!r}: {fault}; it is left out", "incomplete-element")
        return names

    def _above(self, link: str) -> list[str]:
        """Return the joints from a link up to the root."""
        names: list[str] = []
        while link:
            joint = self._holder[link]
            names.append(joint.name)
            link = joint.parent_link
        return names

    def _end_effectors(self, members: Mapping[str, list[JointModel]]) -> dict[str, EndEffector]:
        found: dict[str, EndEffector] = {}
        for written in self._srdf.end_effectors:
            fault = ""
            if written.group not in members:
                fault = no_such("no group", written.group, members)
            elif written.parent_link not in self._holder:
                fault = no_such("no link", written.parent_link, self._holder)
            elif written.name in found:
                fault = "the name is taken"
            if fault:
                reason = f"end_effector {written.name!r}: {fault}; it is left out"
                self._report.warn(written.at, reason, "missing-link")
                continue
            found[written.name] = EndEffector(
                name=written.name,
                group=written.group,
                parent_link=written.parent_link,
                parent_group=self._parent_group(written, members),
            )
        return found

    def _parent_group(self, written: SrdfEndEffector, members: Mapping[str, list[JointModel]]) -> str:
        """Return the group that moves an end effector: the one named, else the smallest with the parent link, as in
        MoveIt, even if the two share links.
        """
        fitting = [
            name for name, joints in members.items() if name != written.group and _holds(joints, written.parent_link)
        ]
        if written.parent_group in fitting:
            return written.parent_group
        smallest = min(fitting, key=lambda name: (len(members[name]), name), default="")
        if written.parent_group:
            fault = f"parent_group {written.parent_group!r} is not one with the link {written.parent_link!r}"
            if written.parent_group not in members:
                fault = no_such("no parent_group", written.parent_group, members)
            instead = f"{smallest!r} is taken" if smallest else "it has none"
            self._report.warn(written.at, f"end_effector {written.name!r}: {fault}; {instead}", "missing-link")
        return smallest

    def _group(
        self,
        name: str,
        joints: list[JointModel],
        members: Mapping[str, list[JointModel]],
        end_effectors: Mapping[str, EndEffector],
    ) -> JointModelGroup:
        names = {joint.name for joint in joints}
        active = [joint for joint in joints if joint.is_active]
        is_part = {other for other, theirs in members.items() if other != name and names.issuperset(_names(theirs))}
        return JointModelGroup(
            name=name,
            joints=tuple(joint.name for joint in active),
            all_joints=tuple(joint.name for joint in joints),
            variables=tuple(variable for joint in active for variable in joint.variables),
            all_variables=tuple(variable for joint in joints for variable in joint.variables),
            links=tuple(joint.child_link for joint in joints),
            updated_links=self._below(names),
            tips=self._tips(joints),
            base=self._base(joints),
            is_chain=self._is_chain(joints),
            default_states={},
            end_effector=next((eef for eef in end_effectors.values() if eef.group == name), None),
            attached_end_effectors=tuple(
                eef.name for eef in end_effectors.values() if eef.group != name and _holds(joints, eef.parent_link)
            ),
            subgroups=tuple(other for other in members if other in is_part),
        )

    def _below(self, names: set[str]) -> tuple[str, ...]:
        moved: set[str] = set()
        for joint in self._joints:  # parents first
            follows = joint.mimic is not None and joint.mimic.joint in names
            if follows or joint.name in names or joint.parent_link in moved:
                moved.add(joint.child_link)
        return tuple(joint.child_link for joint in self._joints if joint.child_link in moved)

    def _tips(self, joints: list[JointModel]) -> tuple[str, ...]:
        """Return the links below which no joint of the group is, also not after joints that it leaves out."""
        above: set[str] = set()
        for joint in joints:
            link = joint.parent_link
            while link and link not in above:
                above.add(link)
                link = self._holder[link].parent_link
        return tuple(joint.child_link for joint in joints if joint.child_link not in above)

    def _base(self, joints: list[JointModel]) -> str:
        """Return the lowest link above all joints."""
        common: list[str] | None = None
        for joint in joints:
            links: list[str] = []
            link = joint.parent_link
            while link:
                links.append(link)
                link = self._holder[link].parent_link
            common = links if common is None else [link for link in common if link in set(links)]
        return common[0] if common else ""

    def _is_chain(self, joints: list[JointModel]) -> bool:
        return any(joint.is_active for joint in joints) and all(
            self._precedes(before.name, joint) for before, joint in pairwise(joints)
        )

    def _precedes(self, before: str, joint: JointModel) -> bool:
        """Return True if a joint hangs on the one before, with only fixed joints between, as MoveIt defines chains."""
        link = joint.parent_link
        while link:
            holder = self._holder[link]
            if holder.name == before:
                return True
            if holder.type != "fixed":
                return False
            link = holder.parent_link
        return False

    def _add_state(self, state: SrdfState, groups: Mapping[str, JointModelGroup]) -> None:
        where = f"group_state {state.name!r}"
        group = groups.get(state.group)
        if group is None:
            fault = no_such("no group", state.group, groups)
            self._report.warn(state.at, f"{where}: {fault}; it is left out", "missing-link")
            return
        positions: dict[str, float] = {}
        for name, values in state.positions.items():
            joint = self._joints[self._order[name]] if name in group.all_joints else None
            if joint is None:
                fault = no_such(f"group {group.name!r} has no joint", name, group.all_joints)
                self._report.warn(state.at, f"{where}: {fault}; it is left out", "missing-link")
            elif len(values) != len(joint.variables):
                fault = f"{len(values)} values of joint {name!r}, which has {len(joint.variables)}"
                self._report.warn(state.at, f"{where}: {fault}; they are left out", "invalid-value")
            else:
                positions.update(zip(joint.variables, values, strict=True))
        if state.name in group.default_states:
            self._report.warn(state.at, f"a second {where} of {group.name!r}; it is used", "duplicate-name")
        group.default_states[state.name] = positions


def _holds(joints: Sequence[JointModel], link: str) -> bool:
    """True if a group of joints has a link."""
    return any(joint.child_link == link for joint in joints)


def _names(joints: Iterable[JointModel]) -> set[str]:
    return {joint.name for joint in joints}


def _leaves_first(groups: Mapping[str, SrdfGroup], report: Diagnostics) -> list[str]:
    """Return the groups, subgroups before those that contain them; one with a faulty subgroup is without it."""
    order: list[str] = []
    state: dict[str, bool] = {}  # False while its subgroups are looked at
    for first in groups:
        pending = [first]
        while pending:
            name = pending[-1]
            if name in state:
                pending.pop()
                if not state[name]:
                    state[name] = True
                    order.append(name)
                continue
            state[name] = False
            for subgroup in groups[name].subgroups:
                fault = ""
                if subgroup not in groups:
                    fault = no_such("no subgroup", subgroup, groups)
                elif state.get(subgroup) is False:
                    fault = f"its subgroup {subgroup!r} contains it"
                else:
                    pending.append(subgroup)
                if fault:
                    report.warn(groups[name].at, f"group {name!r}: {fault}; it is left out", "missing-link")
    return order
