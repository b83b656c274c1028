"""SRDF as written: groups, their states, end effectors, and links that need no collision check.

Elements and attributes are those of srdfdom (https://wiki.ros.org/srdf).
"""

from typing import Literal, TypeAlias

from msgspec import Struct

from trundle.base.diagnostics import Source

VirtualJointType: TypeAlias = Literal["fixed", "planar", "floating"]


class SrdfChain(Struct, frozen=True, kw_only=True):
    """<chain>: every joint from one link to another."""

    base_link: str
    tip_link: str


class SrdfGroup(Struct, frozen=True, kw_only=True):
    """<group>: its parts together."""

    name: str
    at: Source
    joints: tuple[str, ...] = ()
    links: tuple[str, ...] = ()
    """Links whose parent joints belong to the group."""
    chains: tuple[SrdfChain, ...] = ()
    subgroups: tuple[str, ...] = ()


class SrdfState(Struct, frozen=True, kw_only=True):
    """<group_state>: named positions of a group's joints."""

    name: str
    group: str
    at: Source
    positions: dict[str, tuple[float, ...]] = {}
    """Joint → a value for each of its variables [rad, m]."""


class SrdfEndEffector(Struct, frozen=True, kw_only=True):
    """<end_effector>: a group of joints, attached to a link of another group."""

    name: str
    group: str
    parent_link: str
    parent_group: str
    """Empty: none named."""
    at: Source


class SrdfVirtualJoint(Struct, frozen=True, kw_only=True):
    """<virtual_joint>: how the root link moves in the world."""

    name: str
    type: VirtualJointType
    parent_frame: str
    child_link: str
    at: Source


class DisabledPair(Struct, frozen=True, kw_only=True):
    """<disable_collisions> of two links, with the reason as written: Adjacent, Never, Always, Default or User."""

    link1: str
    link2: str
    reason: str
    at: Source


class Srdf(Struct, frozen=True, kw_only=True):
    """<robot> of an SRDF."""

    name: str
    at: Source
    groups: tuple[SrdfGroup, ...] = ()
    states: tuple[SrdfState, ...] = ()
    end_effectors: tuple[SrdfEndEffector, ...] = ()
    virtual_joints: tuple[SrdfVirtualJoint, ...] = ()
    passive_joints: tuple[str, ...] = ()
    disabled: tuple[DisabledPair, ...] = ()
    unchecked: tuple[str, ...] = ()
    """Links of <disable_default_collisions>: checked only against links of <enable_collisions>."""
    enabled: tuple[tuple[str, str], ...] = ()
    joint_properties: dict[str, dict[str, str]] = {}
    """Joint → property → value."""
