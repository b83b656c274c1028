"""Fields of joints."""

from collections.abc import Sequence

from trundle.base.xmlnode import XmlElement

from .field import Field, Section
from .shape_fields import NAME, POSE, XYZ

JOINT_TYPES = ("revolute", "continuous", "prismatic", "fixed", "ball", "universal", "screw", "revolute2")
_AXES = {"fixed": 0, "ball": 0, "universal": 2, "revolute2": 2}
WORLD = "world"


def axis_count(kind: str) -> int:
    """Return the number of axis elements of a joint of a type."""
    return _AXES.get(kind, 1)


def joint_sections(joint: XmlElement, links: Sequence[str]) -> list[Section]:
    """Return the sections of a <joint>; `links` are the names of its model's links."""
    kind = joint.get("type") or ""
    joint_fields = (
        NAME,
        Field(name="@type", label="Type", kind="choice", choices=JOINT_TYPES),
        Field(name="parent", label="Parent", kind="choice", choices=(WORLD, *links)),
        Field(name="child", label="Child", kind="choice", choices=tuple(links)),
        POSE,
    )
    tags = ("axis", "axis2")[: axis_count(kind)]
    axes = [_axis_section(tag, kind) for tag in tags]
    thread = [Section(title="Thread", fields=(Field(name="thread_pitch", label="Pitch", default="1"),))]
    return [Section(title="Joint", fields=joint_fields), *axes, *(thread if kind == "screw" else [])]


def _axis_section(tag: str, kind: str) -> Section:
    is_prismatic = kind == "prismatic"
    unit, speed, force = ("m", "m/s", "N") if is_prismatic else ("rad", "rad/s", "N·m")
    limits = (
        Field(name=f"{tag}/limit/lower", label="Lower", unit=unit),
        Field(name=f"{tag}/limit/upper", label="Upper", unit=unit),
    )
    damping = "N s/m" if is_prismatic else "N·m s/rad"
    return Section(
        title="Axis" if tag == "axis" else "Second axis",
        fields=(
            Field(name=f"{tag}/xyz", label="Direction", kind="vector", labels=XYZ, default="0 0 1"),
            *(() if kind == "continuous" else limits),
            Field(name=f"{tag}/limit/effort", label="Effort", unit=force),
            Field(name=f"{tag}/limit/velocity", label="Velocity", unit=speed),
            Field(name=f"{tag}/dynamics/damping", label="Damping", unit=damping, minimum=0.0, default="0"),
            Field(name=f"{tag}/dynamics/friction", label="Friction", unit=force, minimum=0.0, default="0"),
        ),
    )
