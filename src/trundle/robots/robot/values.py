"""Readers of numeric URDF attributes; an invalid value gives a warning, and None or the default."""

from trundle.base.diagnostics import Diagnostics
from trundle.base.xmlnode import MAX_LENGTH, MAX_NUMBER, XmlNode, is_within, parse_numbers
from trundle.spatial import Pose, Vector3


def read_origin(node: XmlNode, report: Diagnostics) -> Pose:
    origin = node.find("origin")
    if origin is None:
        return Pose()
    parts: list[Vector3] = []
    for key in ("xyz", "rpy"):
        vector = (
            (0.0, 0.0, 0.0) if origin.attribute(key) is None else read_vector(origin, key, report, limit=MAX_LENGTH)
        )
        parts.append(vector or (0.0, 0.0, 0.0))
    return Pose.from_rpy(*parts[0], *parts[1])


def read_vector(node: XmlNode, key: str, report: Diagnostics, *, limit: float = MAX_NUMBER) -> Vector3 | None:
    text = node.attribute(key)
    values = parse_numbers(text or "")
    if values is None or len(values) != 3 or not is_within(values, limit):
        fault = f"<{node.tag} {key}={text!r}> needs three numbers within ±{limit:g}"
        report.warn(node.at, f"{fault}; it is ignored", "invalid-value")
        return None
    return (values[0], values[1], values[2])


def read_number(node: XmlNode, key: str, report: Diagnostics, *, limit: float = MAX_NUMBER) -> float | None:
    text = node.attribute(key)
    values = parse_numbers(text or "")
    if values is None or len(values) != 1 or not is_within(values, limit):
        report.warn(node.at, f"<{node.tag} {key}={text!r}> needs one number within ±{limit:g}", "invalid-value")
        return None
    return values[0]


def read_optional(node: XmlNode | None, key: str, default: float, report: Diagnostics) -> float:
    if node is None or node.attribute(key) is None:
        return default
    value = read_number(node, key, report)
    return default if value is None else value
