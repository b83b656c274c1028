"""Selection of a model folder's SDF file by model.config."""

import os
from pathlib import Path

from trundle.assets import ASSETS
from trundle.base.diagnostics import DescriptionError, Diagnostics, Source
from trundle.base.xmlnode import XmlNode, read_xml

NEWEST = (1, 12)
"""Newest supported SDF version."""
_TEMPLATES = frozenset({".erb", ".rsdf"})


def model_file(folder: Path, report: Diagnostics) -> Path:
    """Return the SDF file of a model folder's model.config with the newest supported version.

    Raises:
        DescriptionError: no model.config, or its file is missing.
    """
    config = folder / "model.config"
    if not os.path.exists(config):
        manifest = folder / "manifest.xml"
        if not os.path.exists(manifest):
            raise DescriptionError(
                Source(str(folder)), f"no model.config in this folder; there is: {_listed(folder)}", "model-config"
            )
        report.warn(Source(str(manifest)), "manifest.xml is deprecated; name it model.config", "model-config")
        config = manifest
    root = read_xml(config, report=report)
    elements = root.all("sdf")
    if not elements:
        raise DescriptionError(Source(str(config)), "no <sdf> element names the model's file", "model-config")
    best = max(elements, key=lambda node: _rank(node, report))
    if _rank(best, report) == _TOO_NEW:
        newest = ".".join(map(str, NEWEST))
        report.warn(
            best.at, f"SDF {best.attribute('version')} is newer than {newest}; it is read as {newest}", "sdf-version"
        )
    if folder.parent == ASSETS / "stand_ins":
        report.info(
            root.at,
            f"model://{folder.name} is not on GAZEBO_MODEL_PATH; {root.string('description')}",
            "stand-in-model",
        )
    path = folder / best.text
    if not os.path.isfile(path) or not Path(os.path.realpath(path)).is_relative_to(os.path.realpath(folder)):
        raise DescriptionError(
            best.at, f"no file {best.text!r} in {folder}; there is: {_listed(folder)}", "model-config"
        )
    refuse_template(path)
    return path


def refuse_template(path: Path) -> None:
    """Refuse Ruby templates, from which some worlds are generated.

    Raises:
        DescriptionError: the file is a template.
    """
    if path.suffix in _TEMPLATES:
        output = path.with_suffix("").name if path.suffix == ".erb" else f"{path.stem}.sdf"
        raise DescriptionError(
            Source(str(path)),
            f"a Ruby template, which is not run; expand it first: erb {path.name} > {output}",
            "erb-template",
        )


_NO_VERSION = (-1,)
_TOO_NEW = (-2,)


def _rank(node: XmlNode, report: Diagnostics) -> tuple[int, ...]:
    text = node.attribute("version")
    if text is None:
        report.warn(node.at, "<sdf> without a version; it is used only if there is no other", "model-config")
        return _NO_VERSION
    try:
        version = tuple(int(part) for part in text.split("."))
    except ValueError:
        report.warn(
            node.at, f"<sdf version={text!r}> is not a version; it is used only if there is no other", "model-config"
        )
        return _NO_VERSION
    return version if version <= NEWEST else _TOO_NEW


def _listed(folder: Path) -> str:
    try:
        names = sorted(os.listdir(folder))
    except OSError:
        names = []
    return ", ".join(names[:12]) + (", …" if len(names) > 12 else "") if names else "nothing"
