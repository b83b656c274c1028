"""Shared context of reading one SDF file."""

import math
from collections.abc import Callable, Iterable
from pathlib import Path

from msgspec import Struct, field
from msgspec.structs import replace

from trundle.base.diagnostics import Diagnostics, Source
from trundle.base.xmlnode import MAX_LENGTH, ReadBudget, XmlNode
from trundle.robots.model import EVERY_BIT, Model
from trundle.robots.packages import Packages
from trundle.spatial import Pose

from .version import Version

DEEPEST = 2_000
"""Maximum nesting depth of elements; Gazebo has no limit. No reader here recurses that deep."""


class Context(Struct, frozen=True, kw_only=True):
    """File being read."""

    version: Version
    folder: Path
    """Folder of the file, the base of relative URIs."""
    packages: Packages
    report: Diagnostics
    including: tuple[Path, ...] = ()
    """Including files, outermost first, to detect cycles."""
    budget: ReadBudget = field(default_factory=ReadBudget)
    """Budget shared with all included files."""
    read_urdf: Callable[[Path, XmlNode], Model] | None = None
    """Reads the <robot> of an included file."""
    seed: int = 0
    """Seed of random placement."""
    ignored: set[tuple[str, str, str]] = field(default_factory=set[tuple[str, str, str]])
    """(file, element, child) already reported by `warn_ignored`."""

    def for_include(self, file: Path, version: Version) -> "Context":
        """Return the context of an included file."""
        resolved = file.resolve()
        return replace(
            self,
            version=version,
            folder=resolved.parent,
            packages=self.packages.for_included(file),
            including=(*self.including, resolved),
        )


def warn_ignored(node: XmlNode, tags: Iterable[str], why: str, context: Context) -> None:
    """Note ignored children, once per file; `why` follows the tag in the message."""
    for tag in tags:
        child, key = node.find(tag), (node.at.file, node.tag, tag)
        if child is not None and key not in context.ignored:
            context.ignored.add(key)
            context.report.info(child.at, f"<{tag}> in <{node.tag}> {why}; it is ignored", "ignored-element")


def read_bits(node: XmlNode, tag: str, *, default: int = EVERY_BIT) -> int:
    """Return a child's bit mask."""
    return node.integer(tag, default=default) & EVERY_BIT


class RawPose(Struct, frozen=True):
    """<pose> as written, with the frame to which it is relative."""

    pose: Pose = Pose()
    relative_to: str | None = None
    at: Source | None = None


def read_pose(node: XmlNode, context: Context) -> RawPose:
    """Return an element's <pose>, or the identity in its default frame."""
    child = node.find("pose")
    if child is None:
        return RawPose()
    relative_to, frame = child.attribute("relative_to"), child.attribute("frame")
    # SDF 1.5 and 1.6 named it `frame`; Gazebo 11 converts it to `relative_to` for versions below 1.7 only.
    if context.version < (1, 7):
        relative_to = relative_to if frame is None else frame
    elif frame:
        context.report.warn(child.at, f"<pose frame={frame!r}> is ignored: SDF 1.7 calls it relative_to", "pose-frame")
    return RawPose(_numbers(child, context), relative_to or None, child.at)


def _numbers(child: XmlNode, context: Context) -> Pose:
    degrees = (child.attribute("degrees") or "").strip().lower() in ("true", "1")
    if child.attribute("rotation_format") == "quat_xyzw":
        values = child.as_numbers(7, fallback="the identity is used", limit=MAX_LENGTH)
        if values is None:
            return Pose()
        x, y, z, qx, qy, qz, qw = values
        length = math.hypot(qw, qx, qy, qz)
        if length == 0.0:
            context.report.warn(child.at, "<pose>: a quaternion of zero length; no rotation is used", "zero-vector")
            return Pose((x, y, z))
        return Pose((x, y, z), (qw / length, qx / length, qy / length, qz / length))
    if not degrees:
        return child.as_pose()
    values = child.as_numbers(6, fallback="the identity is used", limit=MAX_LENGTH)
    if values is None:
        return Pose()
    x, y, z, *turns = values
    return Pose.from_rpy(x, y, z, *map(math.radians, turns))
