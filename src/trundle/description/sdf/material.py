"""Reads <material>: colours given outright, or a Gazebo material by name."""

from trundle.model import GREY, Material, Rgba
from trundle.xmlnode import XmlNode

from ..ogre import find_material
from .context import Context
from .gazebo_materials import GAZEBO_MATERIALS, TEXTURED


def read_material(visual: XmlNode, context: Context) -> Material:
    """The colours of a visual; those written out override the named script's."""
    node = visual.find("material")
    if node is None:
        return GREY
    script = node.find("script")
    base = GREY
    if script is not None:
        name = script.string("name") or script.text  # SDF 1.0 has the name as the text
        base = named_material(name, script, context)
        script.report_unread(context.report)
    material = Material(
        ambient=read_colour(node, "ambient", base.ambient, context),
        diffuse=read_colour(node, "diffuse", base.diffuse, context),
        specular=read_colour(node, "specular", base.specular, context),
        emissive=read_colour(node, "emissive", base.emissive, context),
        texture=base.texture,
    )
    for tag in ("lighting", "shader", "render_order", "double_sided"):
        node.find(tag)
    shininess = node.find("shininess")
    if shininess is not None:
        context.report.info(shininess.at, "<shininess> is not drawn; highlights are as Gazebo's materials have them")
    if node.find("pbr") is not None:
        context.report.info(node.at, "<pbr> is for other renderers; its plain colours are drawn")
    node.report_unread(context.report)
    return material


def named_material(name: str, node: XmlNode, context: Context) -> Material:
    """A material of Gazebo's, or of the scripts that the <uri>s name; an unknown one is grey, after a warning."""
    if name in GAZEBO_MATERIALS:
        node.all("uri")
        return GAZEBO_MATERIALS[name]
    scripted = find_material(name, node, packages=context.packages, report=context.report)
    if scripted is not None:
        return scripted
    if name in TEXTURED:
        r, g, b = TEXTURED[name]
        context.report.info(node.at, f"material {name!r} has a texture that only Gazebo ships; a plain colour is used")
        return Material(ambient=(r, g, b, 1.0), diffuse=(r, g, b, 1.0))
    context.report.warn(node.at, f"no material {name!r}; grey is used")
    return GREY


def read_colour(node: XmlNode, tag: str, default: Rgba, context: Context) -> Rgba:
    """A child's r g b a, each held to 0…1."""
    child = node.find(tag)
    if child is None:
        return default
    values = [float(v) for v in _numbers(child.text)]
    if len(values) == 3:
        values.append(1.0)
    if len(values) != 4:
        context.report.warn(child.at, f"<{tag}> wants r g b a, got {child.text!r}; the default is used")
        return default
    r, g, b, a = (min(max(v, 0.0), 1.0) for v in values)
    return (r, g, b, a)


def _numbers(text: str) -> list[float]:
    try:
        return [v for v in map(float, text.split()) if v == v]  # NaN is not equal to itself
    except ValueError:
        return []
