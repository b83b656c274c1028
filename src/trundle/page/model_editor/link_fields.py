"""Fields of links and of the model itself."""

from trundle.base.xmlnode import XmlElement
from trundle.robots.description import enclosed_volume
from trundle.robots.model import Link

from .field import Field, Section
from .shape_fields import NAME, POSE, color_section, friction_section, has_one_shape, size_fields

DENSITY = "density"
"""Name of the field that sets mass and inertia from the volume of the collisions."""
MASS = "inertial/mass"
_MIN_KG = 1e-9


def model_sections() -> list[Section]:
    """Return the sections of a <model>."""
    fields = (
        NAME,
        Field(name="static", label="Static", kind="flag", default="false"),
        Field(name="self_collide", label="Self collide", kind="flag", default="false"),
        Field(name="allow_auto_disable", label="May sleep", kind="flag", default="true"),
    )
    return [Section(title="Model", fields=fields)]


def link_sections(element: XmlElement, link: Link | None) -> list[Section]:
    """Return the sections of a <link>.

    Args:
        element: link's element.
        link: link as read from the element; None: its name is not unique.
    """
    link_fields = (
        NAME,
        POSE,
        Field(name="gravity", label="Gravity", kind="flag", default="true"),
        Field(name="self_collide", label="Self collide", kind="flag", default="false"),
    )
    sections = [Section(title="Link", fields=link_fields)]
    if has_one_shape(element):
        sections.append(Section(title="Shape", fields=size_fields(element, ("collision", "visual"))))
    if len(element.all("visual")) == 1:
        sections.append(color_section("visual/"))
    if len(element.all("collision")) == 1:
        sections.append(friction_section("collision/"))
    return [*sections, _inertia_section(link)]


def _inertia_section(link: Link | None) -> Section:
    volume = None if link is None else enclosed_volume(link.collisions)
    density: tuple[Field, ...] = ()
    if link is not None and volume:
        derived = (link.inertial.mass / volume,)
        density = (Field(name=DENSITY, label="Density", unit="kg/m³", minimum=_MIN_KG, derived=derived),)
    moments = (f"inertial/inertia/{name}" for name in ("ixx", "iyy", "izz", "ixy", "ixz", "iyz"))
    return Section(
        title="Mass and inertia",
        fields=(
            Field(name=MASS, label="Mass", unit="kg", minimum=_MIN_KG, default="1"),
            *density,
            *(
                Field(name=path, label=path[-3:], unit="kg m²", default="1" if path[-2] == path[-1] else "0")
                for path in moments
            ),
            Field(name="inertial/pose", label="Center of mass", kind="pose", default="0 0 0 0 0 0"),
        ),
    )
