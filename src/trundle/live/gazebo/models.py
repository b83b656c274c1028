"""Reader of a spawned model's text."""

import re
from pathlib import Path

from trundle.base.diagnostics import DescriptionError, Diagnostics, UsageError
from trundle.base.xmlnode import parse_xml
from trundle.robots.description import load
from trundle.robots.model import Model
from trundle.robots.packages import Packages
from trundle.robots.robot import Robot

_URDF = re.compile(r"<robot[\s>]")


def read_spawned(
    xml: str, *, name: str, namespace: str, folder: Path, packages: Packages, report: Diagnostics
) -> tuple[Model, Robot | None]:
    """Read the one model of an SDF or URDF text, and the URDF's own tree.

    Args:
        xml: the text; it is kept in a file, so that messages can name its lines.
        name: the model's name in the world.
        namespace: robotNamespace of its plugins that have none, as in gazebo_ros; empty: leave them.
        folder: of that file.
        packages: resolve URIs.
        report: takes all findings.

    Raises:
        TrundleError: no model, or several.
    """
    if not xml.strip():
        raise UsageError(f"model {name!r}: its text is empty")
    suffix = "urdf" if _URDF.search(xml) else "sdf"
    file = folder / f"{re.sub(r'[^A-Za-z0-9_.-]', '_', name)}.{suffix}"
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(_in_namespace(xml, namespace) if namespace else xml, encoding="utf-8")
    loaded = load(str(file), report, packages=packages)
    models = loaded.world.models
    if len(models) != 1:
        raise UsageError(f"model {name!r}: the text describes {len(models)} models; one is needed")
    return models[0], loaded.robot


def _in_namespace(xml: str, namespace: str) -> str:
    """Write <robotNamespace> into every plugin that has none."""
    try:
        root = parse_xml(xml, name="", report=Diagnostics())
    except DescriptionError:
        return xml  # the reader reports it with its line
    pending = [root]
    while pending:
        node = pending.pop()
        if node.tag != "plugin":
            pending += node.children
        elif node.find("robotNamespace") is None:
            node.write("robotNamespace", namespace)
    return root.xml()
