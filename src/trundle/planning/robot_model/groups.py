"""Groups of joints, and end effectors."""

from msgspec import Struct


class EndEffector(Struct, frozen=True, kw_only=True):
    """Group of joints attached to a link of another group."""

    name: str
    group: str
    """Group of the end effector's own joints."""
    parent_link: str
    parent_group: str
    """Group that moves it; empty: none does."""


class JointModelGroup(Struct, frozen=True, kw_only=True):
    """Joints that are planned together."""

    name: str
    joints: tuple[str, ...]
    """Active joints, parents first: those with variables that follow no other."""
    all_joints: tuple[str, ...]
    """With fixed and mimic joints."""
    variables: tuple[str, ...]
    """Variables of the active joints."""
    all_variables: tuple[str, ...]
    """With those of mimic joints: MoveIt's getVariableNames()."""
    links: tuple[str, ...]
    """Child links of all joints."""
    updated_links: tuple[str, ...]
    """Links that move with the group, also those of other groups."""
    tips: tuple[str, ...]
    """Links below which the group has no joint."""
    base: str
    """Link below which all joints are."""
    is_chain: bool
    """True if each joint hangs on the one before, fixed ones between them left out."""
    default_states: dict[str, dict[str, float]] = {}
    """<group_state> name → variable → position [rad] or [m]."""
    end_effector: EndEffector | None = None
    """End effector that these joints are."""
    attached_end_effectors: tuple[str, ...] = ()
    """End effectors that the group moves."""
    subgroups: tuple[str, ...] = ()
    """Groups all of whose joints are in this one, too."""
