"""spawn_model's -trimesh: a mesh as a model with one link.

The script's usage lists these options up to Kinetic, but no version implements them.
"""

import os
from collections.abc import Mapping
from pathlib import Path
from xml.etree.ElementTree import Element, SubElement, tostring

from trundle.base.diagnostics import UsageError

_OPTIONS = ("mass", "ixx", "iyy", "izz", "gravity", "material", "name")
_BOOLEANS = {"true": "true", "1": "true", "false": "false", "0": "false"}


def trimesh_sdf(file: str, options: Mapping[str, str]) -> str:
    """Generate the model's SDF.

    Args:
        file: mesh file.
        options: values of the `-trimesh_…` options by the name after `trimesh_`; all are required.

    Raises:
        UsageError: an option is missing, unknown or invalid, or the file does not exist.
    """
    missing = [f"-trimesh_{option}" for option in _OPTIONS if option not in options]
    unknown = [f"-trimesh_{option}" for option in options if option not in _OPTIONS]
    if missing or unknown:
        raise UsageError(f"-trimesh needs {', '.join(missing)}" if missing else f"no option {unknown[0]!r}")
    if not os.path.isfile(file):
        raise UsageError(f"-file {file}: no such file")
    gravity = _BOOLEANS.get(options["gravity"].lower())
    if gravity is None:
        raise UsageError(f"-trimesh_gravity must be true or false, got {options['gravity']!r}")
    sdf = Element("sdf", version="1.4")
    link = SubElement(SubElement(sdf, "model", name="trimesh"), "link", name=options["name"])
    SubElement(link, "gravity").text = gravity
    inertial = SubElement(link, "inertial")
    SubElement(inertial, "mass").text = _number("mass", options)
    inertia = SubElement(inertial, "inertia")
    for moment in ("ixx", "iyy", "izz"):
        SubElement(inertia, moment).text = _number(moment, options)
    for product in ("ixy", "ixz", "iyz"):
        SubElement(inertia, product).text = "0"
    for part in ("collision", "visual"):
        shape = SubElement(link, part, name=part)
        mesh = SubElement(SubElement(shape, "geometry"), "mesh")
        SubElement(mesh, "uri").text = Path(file).absolute().as_uri()
        if part == "visual":
            SubElement(SubElement(SubElement(shape, "material"), "script"), "name").text = options["material"]
    return tostring(sdf, encoding="unicode")


def _number(name: str, options: Mapping[str, str]) -> str:
    try:
        return repr(float(options[name]))
    except ValueError:
        raise UsageError(f"-trimesh_{name}: a number is needed, got {options[name]!r}") from None
