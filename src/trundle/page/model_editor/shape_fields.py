"""Fields of shapes: size, color, friction."""

from trundle.base.xmlnode import XmlElement

from .field import Field, Section

XYZ = ("x", "y", "z")
_SIZES = {
    "box": (Field(name="box/size", label="Size", kind="vector", unit="m", labels=XYZ, minimum=1e-6),),
    "sphere": (Field(name="sphere/radius", label="Radius", unit="m", minimum=1e-6),),
    "cylinder": (
        Field(name="cylinder/radius", label="Radius", unit="m", minimum=1e-6),
        Field(name="cylinder/length", label="Length", unit="m", minimum=1e-6),
    ),
    "capsule": (
        Field(name="capsule/radius", label="Radius", unit="m", minimum=1e-6),
        Field(name="capsule/length", label="Length", unit="m", minimum=1e-6),
    ),
    "ellipsoid": (Field(name="ellipsoid/radii", label="Radii", kind="vector", unit="m", labels=XYZ, minimum=1e-6),),
    "plane": (
        Field(name="plane/normal", label="Normal", kind="vector", labels=XYZ, default="0 0 1"),
        Field(name="plane/size", label="Size", kind="vector", unit="m", labels=("x", "y"), default="1 1"),
    ),
    "mesh": (
        Field(name="mesh/uri", label="URI", kind="text"),
        Field(name="mesh/scale", label="Scale", kind="vector", labels=XYZ, default="1 1 1"),
    ),
}
POSE = Field(name="pose", label="Pose", kind="pose", default="0 0 0 0 0 0")
NAME = Field(name="@name", label="Name", kind="text")


def size_fields(element: XmlElement, tags: tuple[str, ...] = ()) -> tuple[Field, ...]:
    """Return the fields of a shape's size.

    Args:
        element: element with a <geometry>, or the parent of such elements.
        tags: tags of its children that have the same shape; empty: the element itself.
    """
    parents = [element] if not tags else [child for tag in tags if (child := element.find(tag))]
    geometry = parents[0].find("geometry") if parents else None
    shape = next(iter(geometry.children), None) if geometry else None
    if shape is None:
        return ()
    first, *more = [f"{tag}/geometry" for tag in tags] or ["geometry"]
    return tuple(_below(field, first, more) for field in _SIZES.get(shape.tag, ()))


def _below(field: Field, path: str, more: list[str]) -> Field:
    return Field(
        name=f"{path}/{field.name}",
        label=field.label,
        kind=field.kind,
        unit=field.unit,
        labels=field.labels,
        default=field.default,
        minimum=field.minimum,
        maximum=field.maximum,
        also=tuple(f"{other}/{field.name}" for other in more),
    )


def has_one_shape(link: XmlElement) -> bool:
    """True if a link has one visual and one collision with the same geometry and pose."""
    visuals, collisions = link.all("visual"), link.all("collision")
    if len(visuals) != 1 or len(collisions) != 1:
        return False
    return all(_canonical(visuals[0].find(tag)) == _canonical(collisions[0].find(tag)) for tag in ("geometry", "pose"))


def _canonical(element: XmlElement | None) -> object:
    if element is None:
        return None
    return element.tag, element.text.split(), [_canonical(child) for child in element.children]


def color_section(prefix: str = "") -> Section:
    """Return the fields of a visual's color; `prefix` is the path to the visual."""
    path = f"{prefix}material"
    color = Field(
        name=f"{path}/diffuse",
        label="Color",
        kind="color",
        minimum=0.0,
        maximum=1.0,
        also=(f"{path}/ambient",),
        default="0.7 0.7 0.7 1",
    )
    return Section(title="Look", fields=(color,))


def friction_section(prefix: str = "") -> Section:
    """Return the fields of a collision's friction; `prefix` is the path to the collision."""
    path = f"{prefix}surface/friction/ode"
    return Section(
        title="Friction",
        fields=tuple(
            Field(name=f"{path}/{mu}", label=mu, minimum=0.0, maximum=1e6, default="1") for mu in ("mu", "mu2")
        ),
    )


def shape_sections(element: XmlElement) -> list[Section]:
    """Return the sections of a <visual> or <collision>."""
    shape = Section(title="Shape", fields=size_fields(element))
    surface = color_section() if element.tag == "visual" else friction_section()
    return [Section(title=element.tag.capitalize(), fields=(NAME, POSE)), shape, surface]
