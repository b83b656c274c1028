"""Full precision for MJCF that MuJoCo saved with six digits."""

from collections.abc import Iterable, Mapping
from typing import Any
from xml.etree import ElementTree as Xml

import mujoco
import numpy as np

_CLOSE = 1e-5
"""Rounding error of six digits."""
_NAMES: Mapping[str, Mapping[str, str]] = {
    "inertial": {"pos": "ipos", "quat": "iquat", "diaginertia": "inertia"},
    "mesh": {"vertex": "uservert"},
    "joint": {
        "solreflimit": "solref_limit",
        "solimplimit": "solimp_limit",
        "solreffriction": "solref_friction",
        "solimpfriction": "solimp_friction",
        "actuatorfrcrange": "actfrcrange",
    },
    "equality": {"polycoef": "data", "anchor": "data"},
    "hfield": {"elevation": "userdata"},
}
"""Element → attribute → field of the specification, where the names differ."""


def with_full_precision(xml: str, spec: mujoco.MjSpec) -> str:
    """Return the XML saved from a specification, with the specification's exact numbers."""
    root = Xml.fromstring(xml)
    for element in root.iter("option"):
        _restore(element, spec.option, {})
    named: list[tuple[str, Iterable[Any]]] = [
        ("mesh", spec.meshes),
        ("hfield", spec.hfields),
        ("material", spec.materials),
        ("pair", spec.pairs),
        ("light", spec.lights),
    ]
    for tag, objects in named:
        by_name = {item.name: item for item in objects}
        for element in root.iter(tag):
            if (source := by_name.get(element.get("name", ""))) is not None:
                _restore(element, source, _NAMES.get(tag, {}))
    for section, objects in (("equality", spec.equalities), ("actuator", spec.actuators)):
        elements = [child for parent in root.iter(section) for child in parent]
        for element, item in zip(elements, objects, strict=False):  # in order of addition; some have no name
            _restore(element, item, _NAMES.get(section, {}))
    bodies = {body.name: body for body in spec.bodies}
    for element in root.iter("body"):
        _restore_body(element, bodies[element.get("name", "")])
    return Xml.tostring(root, encoding="unicode") + "\n"


def _restore_body(element: Xml.Element, body: mujoco.MjsBody) -> None:
    _restore(element, body, {})
    for inertial in element.findall("inertial"):
        _restore(inertial, body, _NAMES["inertial"])
    for tag, objects in (("geom", body.geoms), ("joint", body.joints)):
        for child, item in zip(element.findall(tag), objects, strict=False):
            _restore(child, item, _NAMES.get(tag, {}))


def _restore(element: Xml.Element, source: Any, names: Mapping[str, str]) -> None:
    for attribute, text in element.attrib.items():
        exact = getattr(source, names.get(attribute, attribute), None)
        if exact is None or isinstance(exact, str):
            continue
        try:
            written = np.array(text.split(), dtype=np.float64)
            values = np.ravel(np.asarray(exact, dtype=np.float64))[: len(written)]
        except (TypeError, ValueError):  # not a number
            continue
        if values.shape == written.shape and np.allclose(values, written, rtol=0.0, atol=_CLOSE * np.abs(values).max()):
            element.set(attribute, " ".join(map(_format, values.tolist())))


def _format(value: float) -> str:
    return str(int(value)) if value.is_integer() and abs(value) < 1e15 else repr(value)
