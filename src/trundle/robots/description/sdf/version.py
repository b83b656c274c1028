"""SDF version of a file."""

from trundle.base.diagnostics import Diagnostics
from trundle.base.xmlnode import XmlNode

NEWEST = (1, 12)


class Version(tuple[int, int]):
    """Major and minor version; 1.10 is newer than 1.9."""

    __slots__ = ()

    def __str__(self) -> str:
        return f"{self[0]}.{self[1]}"


def read_version(root: XmlNode, report: Diagnostics) -> Version:
    """Return the version of a root element; the newest, with a warning, if missing or unknown."""
    text = root.attribute("version")
    newest = Version(NEWEST)
    if text is None:
        report.warn(root.at, f"<{root.tag}> has no version; Gazebo refuses the file; read as {newest}", "sdf-version")
        return newest
    try:
        major, minor = (int(part) for part in text.strip().split("."))
    except ValueError:
        report.warn(root.at, f"version {text!r} is not an SDF version; read as {newest}", "sdf-version")
        return newest
    version = Version((major, minor))
    if version > newest:
        report.warn(root.at, f"SDF {version} is newer than {newest}, the newest known; read as {newest}", "sdf-version")
        return newest
    return version
