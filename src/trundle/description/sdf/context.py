"""What every reader of one SDF file needs to know."""

import itertools
import math
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

from msgspec import Struct, field
from msgspec.structs import replace

from trundle.diagnostics import Diagnostics, Source
from trundle.model import EVERY_BIT, Model
from trundle.packages import Packages
from trundle.spatial import Pose
from trundle.xmlnode import XmlNode

from .version import Version

DEEPEST = 2_000
"""Elements within one another that are read; Gazebo has no bound. Nobody here goes down all of them."""


class Context(Struct, frozen=True, kw_only=True):
    """One file being read."""

    version: Version
    folder: Path
    """Of the file: relative URIs start here."""
    packages: Packages
    report: Diagnostics
    including: tuple[Path, ...] = ()
    """The files above this one, outermost first: a model that includes itself is found out."""
    included: Iterator[int] = field(default_factory=itertools.count)
    """Counts every <include> that is opened, in whichever file: models of ten parts of ten parts multiply."""
    read_urdf: Callable[[Path, XmlNode], Model] | None = None
    """Reads a <robot> that an <include> leads to, in its file."""
    seed: int = 0
    """Of what is placed at random."""
    ignored: set[tuple[str, str, str]] = field(default_factory=set[tuple[str, str, str]])
    """File, element and child of what `warn_unsupported` has named."""

    def for_include(self, file: Path, version: Version) -> "Context":
        """The context of a file that this one includes."""
        return replace(self, version=version, folder=file.parent, including=(*self.including, file))


def warn_ignored(node: XmlNode, tags: Iterable[str], why: str, context: Context) -> None:
    """Name children that mean nothing here, once in a file; `why` follows their names."""
    for tag in tags:
        child, key = node.find(tag), (node.at.file, node.tag, tag)
        if child is not None and key not in context.ignored:
            context.ignored.add(key)
            context.report.info(child.at, f"<{tag}> in <{node.tag}> {why}; it is ignored")


def read_bits(node: XmlNode, tag: str, context: Context, *, default: int = EVERY_BIT) -> int:
    """Flags or a mask."""
    return node.integer(tag, default=default, report=context.report) & EVERY_BIT


class RawPose(Struct, frozen=True):
    """A <pose> as written: where, and seen from which frame."""

    pose: Pose = Pose()
    relative_to: str | None = None
    at: Source | None = None


def read_pose(node: XmlNode, context: Context) -> RawPose:
    """Read an element's <pose>; absent, it is the identity where the element is by default."""
    child = node.find("pose")
    if child is None:
        return RawPose()
    relative_to, frame = child.attribute("relative_to"), child.attribute("frame")
    # 1.5 and 1.6 called it `frame`; Gazebo 11 converts it to `relative_to` before it reads on, and from 1.7 on no more.
    if context.version < (1, 7):
        relative_to = relative_to if frame is None else frame
    elif frame:
        context.report.warn(child.at, f"<pose frame={frame!r}> is ignored: SDF 1.7 calls it relative_to")
    return RawPose(_numbers(child, context), relative_to or None, child.at)


def _numbers(child: XmlNode, context: Context) -> Pose:
    degrees = (child.attribute("degrees") or "").strip().lower() in ("true", "1")
    if child.attribute("rotation_format") == "quat_xyzw":
        values = child.as_numbers(7, report=context.report, fallback="the identity is used")
        if values is None:
            return Pose()
        x, y, z, qx, qy, qz, qw = values
        length = math.hypot(qw, qx, qy, qz)
        if length == 0.0:
            context.report.warn(child.at, "<pose>: a quaternion of zero length turns nothing; no rotation is used")
            return Pose((x, y, z))
        return Pose((x, y, z), (qw / length, qx / length, qy / length, qz / length))
    if not degrees:
        return child.as_pose(report=context.report)
    values = child.as_numbers(6, report=context.report, fallback="the identity is used")
    if values is None:
        return Pose()
    x, y, z, *turns = values
    return Pose.from_rpy(x, y, z, *map(math.radians, turns))
