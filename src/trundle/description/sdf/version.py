"""The SDF version of a file, which decides how it is read."""

from trundle.diagnostics import Diagnostics
from trundle.xmlnode import XmlNode

NEWEST = (1, 12)


class Version(tuple[int, int]):
    """Major and minor; compares as numbers, so that 1.10 is newer than 1.9."""

    __slots__ = ()

    def __str__(self) -> str:
        return f"{self[0]}.{self[1]}"


def read_version(root: XmlNode, report: Diagnostics) -> Version:
    """The version a root element states; a missing or unknown one is named and read by the newest rules."""
    text = root.attribute("version")
    newest = Version(NEWEST)
    if text is None:
        report.warn(root.at, f"<{root.tag}> has no version, for which Gazebo refuses the file; read as {newest}")
        return newest
    try:
        major, minor = (int(part) for part in text.strip().split("."))
    except ValueError:
        report.warn(root.at, f"version {text!r} is no SDF version; read as {newest}")
        return newest
    version = Version((major, minor))
    if version > newest:
        report.warn(root.at, f"SDF {version} is newer than {newest}, the newest known; read as {newest}")
        return newest
    return version
