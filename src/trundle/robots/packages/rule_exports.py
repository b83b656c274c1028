"""Migration rule files for bags, exported by packages as rosbag plugins."""

from collections.abc import Iterator, Mapping
from pathlib import Path

from trundle.base.diagnostics import DescriptionError
from trundle.base.files import read_file
from trundle.base.xmlnode import XmlNode, read_xml

_EXPORTS = {
    "rosbagmigration": "rule_file",
    "rosbag": "migration_rule_file",
    "rosbag_migration_rule": "rule_file",
}
"""Dependency and <export> tag → attribute with the file's name, in rosbag's order."""


def exported_rules(packages: Mapping[str, Path]) -> list[tuple[str, Path]]:
    """Return packages and their exported rule files; unreadable manifests are skipped.

    Args:
        packages: package folders by name.
    """
    return [
        (name, folder / file.replace("${prefix}/", ""))
        for tag, attribute in _EXPORTS.items()
        for name, folder in sorted(packages.items())
        for file in _exported(folder, tag, attribute)
    ]


def _exported(folder: Path, tag: str, attribute: str) -> Iterator[str]:
    for name in ("package.xml", "manifest.xml"):
        manifest = folder / name
        try:
            if tag.encode() not in read_file(manifest):
                continue
            root = read_xml(manifest)
        except (OSError, DescriptionError):
            continue
        if tag in _depends(root):
            export = root.find("export")
            values = [node.attribute(attribute) for node in (export.all(tag) if export else [])]
            yield from (value for value in values if value)


def _depends(root: XmlNode) -> set[str]:
    """Return all dependencies of a package; rosbuild names them in an attribute."""
    nodes = [node for node in root.children if node.tag.endswith("depend")]
    return {node.attribute("package") or node.text.strip() for node in nodes}
