"""Reader of <material>: explicit colors, a named Gazebo material, or the texture of <pbr>."""

from pathlib import Path

from msgspec.structs import replace

from trundle.base.diagnostics import DescriptionError
from trundle.base.xmlnode import XmlNode
from trundle.robots.model import GREY, TEXTURE_COLORS, Material, Rgba

from .context import Context, warn_ignored
from .gazebo_materials import GAZEBO_MATERIALS, PLAIN

_WHITE: Rgba = (1.0, 1.0, 1.0, 1.0)
"""Default tint of a texture."""


def read_material(visual: XmlNode, context: Context) -> Material:
    """Return the material of a visual; explicit colors override the named script's."""
    node = visual.find("material")
    if node is None:
        return GREY
    script = node.find("script")
    base = GREY
    if script is not None:
        name = script.string("name") or script.text  # SDF 1.0 has the name as text
        base = named_material(name, script, context)
        script.report_unread(context.report)
    image = _albedo(node, context)
    if image is not None:
        base = replace(base, ambient=_WHITE, diffuse=_WHITE, texture=image, texture_scale=(1.0, 1.0))
    material = Material(
        ambient=read_color(node, "ambient", base.ambient, context),
        diffuse=read_color(node, "diffuse", base.diffuse, context),
        specular=read_color(node, "specular", base.specular, context),
        emissive=read_color(node, "emissive", base.emissive, context),
        texture=base.texture,
        texture_scale=base.texture_scale,
        named_texture=base.named_texture if image is None else None,
    )
    warn_ignored(node, ("lighting", "shader", "render_order", "double_sided", "shininess"), "is not drawn", context)
    node.report_unread(context.report)
    return material


def _albedo(material: XmlNode, context: Context) -> Path | None:
    """Return the albedo texture of <pbr>; its other maps are not drawn."""
    pbr = material.find("pbr")
    if pbr is None:
        return None
    report = context.report
    flow = pbr.find("metal") or pbr.find("specular")
    pbr.report_unread(report)
    image = None if flow is None else flow.find("albedo_map")
    others = [] if flow is None else [f"<{child.tag}>" for child in flow.unread()]
    if others:
        report.info(
            pbr.at,
            f"<pbr>: {', '.join(sorted(set(others)))} is for other renderers; it is not drawn",
            "ignored-element",
        )
    if image is None or not image.text:
        return None
    try:
        return context.packages.resolve(image.text, folder=context.folder, at=image.at)
    except DescriptionError as error:
        report.warn(error.at, f"{error.what}; the texture is left out", error.id)
        return None


def named_material(name: str, node: XmlNode, context: Context) -> Material:
    """Return a material of Gazebo's or of the scripts in the <uri>s; grey with a warning if unknown."""
    if name in GAZEBO_MATERIALS:
        node.all("uri")
        return GAZEBO_MATERIALS[name]
    from ..ogre import find_material  # most robots use none but Gazebo's own

    scripted = find_material(name, node, packages=context.packages, report=context.report)
    if scripted is not None:
        return scripted
    if name in TEXTURE_COLORS:
        context.report.info(
            node.at, f"material {name!r} has a texture that only Gazebo ships; Trundle draws its own", "stock-texture"
        )
        return Material(ambient=_WHITE, diffuse=_WHITE, named_texture=name)
    if name in PLAIN:
        r, g, b = PLAIN[name]
        context.report.info(
            node.at, f"material {name!r} has a texture that only Gazebo ships; a plain color is used", "stock-texture"
        )
        return Material(ambient=(r, g, b, 1.0), diffuse=(r, g, b, 1.0))
    context.report.warn(node.at, f"no material {name!r}; grey is used", "missing-material")
    return GREY


def read_color(node: XmlNode, tag: str, default: Rgba, context: Context) -> Rgba:
    """Return a child's r g b a, each clamped to 0…1."""
    child = node.find(tag)
    if child is None:
        return default
    values = [float(v) for v in _numbers(child.text)]
    if len(values) == 3:
        values.append(1.0)
    if len(values) != 4:
        context.report.warn(
            child.at, f"<{tag}> needs r g b a, got {child.text!r}; the default is used", "invalid-value"
        )
        return default
    r, g, b, a = (min(max(v, 0.0), 1.0) for v in values)
    return (r, g, b, a)


def _numbers(text: str) -> list[float]:
    try:
        return [v for v in map(float, text.split()) if v == v]  # NaN is not equal to itself
    except ValueError:
        return []
