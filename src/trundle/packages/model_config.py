"""model.config: which SDF file of a model folder to read."""

from pathlib import Path

from trundle.diagnostics import DescriptionError, Diagnostics, Source
from trundle.xmlnode import XmlNode, read_xml

NEWEST = (1, 12)
"""The newest SDF there is rules for."""


def model_file(folder: Path, report: Diagnostics) -> Path:
    """The SDF file that a model folder's model.config names: the newest version that can be read.

    Raises:
        DescriptionError: no model.config, or it names no file.
    """
    config = folder / "model.config"
    if not config.is_file():
        manifest = folder / "manifest.xml"
        if not manifest.is_file():
            there = ", ".join(sorted(path.name for path in folder.iterdir())) if folder.is_dir() else "nothing"
            raise DescriptionError(Source(str(folder)), f"no model.config in this folder; there is: {there}")
        report.warn(Source(str(manifest)), "manifest.xml is deprecated; name it model.config")
        config = manifest
    named = read_xml(config).all("sdf")
    if not named:
        raise DescriptionError(Source(str(config)), "no <sdf> element names the model's file")
    best = max(named, key=lambda node: _rank(node, report))
    return folder / best.text


def _rank(node: XmlNode, report: Diagnostics) -> tuple[int, ...]:
    text = node.attribute("version")
    if text is None:
        report.warn(node.at, "<sdf> without a version; it is taken only where there is no other")
        return (-1,)
    try:
        version = tuple(int(part) for part in text.split("."))
    except ValueError:
        report.warn(node.at, f"<sdf version={text!r}> is no version; it is taken only where there is no other")
        return (-1,)
    return version if version <= NEWEST else (-2,)
