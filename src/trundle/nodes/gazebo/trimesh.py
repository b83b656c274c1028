"""spawn_model's -trimesh: a mesh as a model of one link.

Its usage names these options up to Kinetic, though no version of the script reads them; here they do what they say.
"""

import os
from collections.abc import Mapping
from pathlib import Path
from xml.etree.ElementTree import Element, SubElement, tostring

from trundle.diagnostics import UsageError

_WORDS = ("mass", "ixx", "iyy", "izz", "gravity", "material", "name")
_TRUE = {"true": "true", "1": "true", "false": "false", "0": "false"}


def trimesh_sdf(file: str, words: Mapping[str, str]) -> str:
    """Write the model.

    Args:
        file: of the mesh.
        words: what `-trimesh_…` say, by what follows `trimesh_`; all are needed.

    Raises:
        UsageError: one is missing, unknown or no value of its kind, or there is no such file.
    """
    missing = [f"-trimesh_{word}" for word in _WORDS if word not in words]
    unknown = [f"-trimesh_{word}" for word in words if word not in _WORDS]
    if missing or unknown:
        raise UsageError(f"-trimesh needs {', '.join(missing)}" if missing else f"no option {unknown[0]!r}")
    if not os.path.isfile(file):
        raise UsageError(f"-file {file}: there is no such file")
    gravity = _TRUE.get(words["gravity"].lower())
    if gravity is None:
        raise UsageError(f"-trimesh_gravity must be true or false, got {words['gravity']!r}")
    sdf = Element("sdf", version="1.4")
    link = SubElement(SubElement(sdf, "model", name="trimesh"), "link", name=words["name"])
    SubElement(link, "gravity").text = gravity
    inertial = SubElement(link, "inertial")
    SubElement(inertial, "mass").text = _number("mass", words)
    inertia = SubElement(inertial, "inertia")
    for moment in ("ixx", "iyy", "izz"):
        SubElement(inertia, moment).text = _number(moment, words)
    for product in ("ixy", "ixz", "iyz"):
        SubElement(inertia, product).text = "0"
    for part in ("collision", "visual"):
        shape = SubElement(link, part, name=part)
        mesh = SubElement(SubElement(shape, "geometry"), "mesh")
        SubElement(mesh, "uri").text = Path(file).absolute().as_uri()
        if part == "visual":
            SubElement(SubElement(SubElement(shape, "material"), "script"), "name").text = words["material"]
    return tostring(sdf, encoding="unicode")


def _number(name: str, words: Mapping[str, str]) -> str:
    try:
        return repr(float(words[name]))
    except ValueError:
        raise UsageError(f"-trimesh_{name}: a number is needed, got {words[name]!r}") from None
