"""Robot model of a URDF and an SRDF."""

from collections.abc import Mapping
from typing import Any

from trundle.base.diagnostics import DescriptionError, Diagnostics, no_such
from trundle.base.xmlnode import parse_xml
from trundle.robots.robot import Robot, read_robot

from .build_groups import GroupBuilder
from .build_joints import build_joints
from .model import RobotModel
from .srdf import DisabledPair, Srdf
from .srdf_reader import read_srdf

MAX_PAIRS = 1_000_000
"""Maximum number of pairs of links that <disable_default_collisions> may amount to."""


def robot_model(
    urdf: str | Robot,
    srdf: str | Srdf | None = None,
    joint_limits: Mapping[str, Any] | None = None,
    report: Diagnostics | None = None,
) -> RobotModel:
    """Build the model of a robot.

    Args:
        urdf: URDF text without xacro, such as the parameter robot_description, or its tree.
        srdf: SRDF text, such as robot_description_semantic, or its tree; None: no groups.
        joint_limits: joint_limits.yaml, such as robot_description_planning; its section `joint_limits`, or all of it.
        report: collects findings.

    Raises:
        DescriptionError: the URDF or SRDF cannot be read; see `read_robot`.
    """
    report = Diagnostics() if report is None else report
    robot = (
        read_robot(parse_xml(urdf, name="robot_description", report=report), report) if isinstance(urdf, str) else urdf
    )
    semantic = read_srdf(srdf, report) if isinstance(srdf, str) else srdf
    if semantic is None:
        semantic = Srdf(name=robot.name, at=robot.at)
    elif semantic.name != robot.name:
        report.warn(
            semantic.at, f"the SRDF is of robot {semantic.name!r}, the URDF of {robot.name!r}; it is used", "wrong-root"
        )
    joints, frame = build_joints(robot, semantic, joint_limits, report)
    groups, end_effectors = GroupBuilder(joints, semantic, report).build()
    links = {joint.child_link: None for joint in joints}
    return RobotModel(
        urdf=robot,
        joints=joints,
        model_frame=frame,
        groups=groups,
        end_effectors=end_effectors,
        disabled=semantic.disabled,
        disabled_pairs=_disabled_pairs(semantic, links, report),
        unchecked_links=frozenset(semantic.unchecked) & frozenset(links),
    )


def _disabled_pairs(srdf: Srdf, links: Mapping[str, None], report: Diagnostics) -> frozenset[frozenset[str]]:
    """Return pairs that are not checked: all pairs of unchecked links but enabled ones, and the disabled ones."""
    if len(srdf.unchecked) * len(links) > MAX_PAIRS:
        reason = f"<disable_default_collisions> for {len(srdf.unchecked)} of {len(links)} links"
        raise DescriptionError(srdf.at, f"{reason}; at most {MAX_PAIRS} pairs are possible", "too-large")
    unknown = [name for name in srdf.unchecked if name not in links]
    for pair in srdf.disabled:
        unknown += _missing(pair, links)
    unknown += [name for pair in srdf.enabled for name in pair if name not in links]
    for name in dict.fromkeys(unknown):
        reason = no_such("no link", name, links)
        report.warn(srdf.at, f"collisions of links: {reason}; its pairs are left out", "missing-link")
    pairs = {frozenset((name, other)) for name in srdf.unchecked if name in links for other in links if other != name}
    pairs -= {frozenset(pair) for pair in srdf.enabled}
    pairs |= {frozenset((p.link1, p.link2)) for p in srdf.disabled if not _missing(p, links) and p.link1 != p.link2}
    return frozenset(pairs)


def _missing(pair: DisabledPair, links: Mapping[str, None]) -> list[str]:
    return [name for name in (pair.link1, pair.link2) if name not in links]
