"""Reader of <geometry>."""

from collections.abc import Callable
from pathlib import Path

from trundle.base.diagnostics import DescriptionError
from trundle.base.xmlnode import MAX_LENGTH, XmlNode
from trundle.robots.model import (
    Box,
    Capsule,
    Cone,
    Cylinder,
    Ellipsoid,
    Empty,
    Geometry,
    Heightmap,
    MeshFile,
    Plane,
    Polyline,
    Sphere,
    TerrainLayer,
)
from trundle.robots.packages import is_stand_in
from trundle.spatial import normalized

from .context import Context, warn_ignored

_UNSUPPORTED = ("image", "voxel_grid")


def read_geometry(owner: XmlNode, context: Context) -> Geometry:
    """Return the shape of a visual or collision; Empty with a warning if unsupported."""
    node = owner.find("geometry")
    report = context.report
    if node is None:
        report.warn(owner.at, f"<{owner.tag}> without <geometry>; it has no shape", "incomplete-element")
        return Empty()
    geometry: Geometry = Empty()
    for tag in _UNSUPPORTED:
        if node.find(tag) is not None:
            report.warn(node.at, f"<{tag}> is not supported; this <{owner.tag}> has no shape", "unsupported-shape")
    polylines = node.all("polyline")
    if polylines:
        geometry = _polyline(polylines, context)
    for tag, read in _READERS.items():
        shape = node.find(tag)
        if shape is not None:
            geometry = read(shape, context)
            shape.report_unread(report)
            break
    if geometry == Empty() and node.find("empty") is None and not list(node.children):
        report.warn(node.at, f"<geometry> names no shape; this <{owner.tag}> has none", "incomplete-element")
    node.report_unread(report)
    return geometry


def _box(shape: XmlNode, _context: Context) -> Box:
    return Box(shape.vector("size", default=(1.0, 1.0, 1.0), limit=MAX_LENGTH))


def _cylinder(shape: XmlNode, _context: Context) -> Cylinder:
    return Cylinder(*_radius_length(shape, 1.0))


def _cone(shape: XmlNode, _context: Context) -> Cone:
    return Cone(*_radius_length(shape, 0.5))


def _capsule(shape: XmlNode, _context: Context) -> Capsule:
    return Capsule(*_radius_length(shape, 0.5))


def _radius_length(shape: XmlNode, radius: float) -> tuple[float, float]:
    length = shape.number("length", default=1.0, limit=MAX_LENGTH)
    return shape.number("radius", default=radius, limit=MAX_LENGTH), length


def _sphere(shape: XmlNode, _context: Context) -> Sphere:
    return Sphere(shape.number("radius", default=1.0, limit=MAX_LENGTH))


def _ellipsoid(shape: XmlNode, _context: Context) -> Ellipsoid:
    return Ellipsoid(shape.vector("radii", default=(1.0, 1.0, 1.0), limit=MAX_LENGTH))


def _plane(shape: XmlNode, context: Context) -> Plane:
    written = shape.vector("normal", default=(0.0, 0.0, 1.0), limit=MAX_LENGTH)
    normal = normalized(written)
    if normal is None:
        context.report.warn(shape.at, "<plane> with a normal of zero length; 0 0 1 is used", "zero-vector")
        normal = (0.0, 0.0, 1.0)
    size = shape.find("size")
    values = None if size is None else size.as_numbers(2, fallback="1 1 is used", limit=MAX_LENGTH)
    return Plane(normal, (1.0, 1.0) if values is None else (values[0], values[1]))


def _mesh(shape: XmlNode, context: Context) -> Geometry:
    uri = shape.string("uri") or shape.string("filename") or shape.attribute("filename")  # the attribute of SDF 1.0
    if not uri:
        context.report.warn(shape.at, "<mesh> without <uri>; it has no shape", "incomplete-element")
        return Empty()
    scale = shape.vector("scale", default=(1.0, 1.0, 1.0), limit=MAX_LENGTH)
    part = shape.find("submesh")
    name = part.string("name") if part is not None else None
    center = part.flag("center", default=False) if part is not None else False
    path = _path(uri, shape, context, "the mesh is left out")
    if path is not None and is_stand_in(path):
        model = uri.removeprefix("model://").partition("/")[0]
        context.report.info(
            shape.at,
            f"model://{model} is not on GAZEBO_MODEL_PATH; plain shapes of about its size are used",
            "stand-in-model",
        )
    return MeshFile(path=path, uri=uri, scale=scale, submesh=name or None, center_submesh=center)


def _heightmap(shape: XmlNode, context: Context) -> Geometry:
    uri, report = shape.string("uri"), context.report
    if not uri:
        report.warn(shape.at, "<heightmap> without <uri>; it has no shape", "incomplete-element")
        return Empty()
    warn_ignored(shape, ("use_terrain_paging",), "does not apply: terrain is kept in memory", context)
    return Heightmap(
        path=_path(uri, shape, context, "the terrain is left out"),
        uri=uri,
        size=shape.vector("size", default=(1.0, 1.0, 1.0), limit=MAX_LENGTH),
        position=shape.vector("pos", default=(0.0, 0.0, 0.0), limit=MAX_LENGTH),
        sampling=shape.integer("sampling", default=1 if context.version >= (1, 8) else 2),
        layers=_layers(shape, context),
    )


def _layers(shape: XmlNode, context: Context) -> tuple[TerrainLayer, ...]:
    """Read each <texture>, with the <blend> between it and the layer below."""
    report = context.report
    layers: list[TerrainLayer] = []
    blends = shape.all("blend")
    for number, node in enumerate(shape.all("texture")):
        blend = blends[number - 1] if 0 < number <= len(blends) else None
        layer = TerrainLayer(
            size=node.number("size", default=10.0, limit=MAX_LENGTH),
            diffuse=_image(node.find("diffuse"), context),
            normal=_image(node.find("normal"), context),
            from_height=0.0 if blend is None else blend.number("min_height", default=0.0, limit=MAX_LENGTH),
            fade=0.0 if blend is None else blend.number("fade_dist", default=0.0, limit=MAX_LENGTH),
        )
        layers.append(layer)
        node.report_unread(report)
    for blend in blends:
        blend.report_unread(report)
    if len(blends) > max(len(layers) - 1, 0):
        message = f"<heightmap> has {len(layers)} <texture> and {len(blends)} <blend>; the last ones are left out"
        report.warn(blends[-1].at, message, "heightmap-blends")
    return tuple(layers)


def _image(node: XmlNode | None, context: Context) -> Path | None:
    if node is None or not node.text:
        return None
    return _path(node.text, node, context, "the texture is left out")


def _polyline(shapes: list[XmlNode], context: Context) -> Geometry:
    outlines: list[tuple[tuple[float, float], ...]] = []
    heights: list[float] = []
    for shape in shapes:
        corners = [point.as_numbers(2, limit=MAX_LENGTH) for point in shape.all("point")]
        outlines.append(tuple((corner[0], corner[1]) for corner in corners if corner is not None))
        heights.append(shape.number("height", default=1.0, limit=MAX_LENGTH))
        shape.report_unread(context.report)
    return Polyline(tuple(outlines), heights[0])


def _path(uri: str, shape: XmlNode, context: Context, otherwise: str) -> Path | None:
    try:
        return context.packages.resolve(uri, folder=context.folder, at=shape.at)
    except DescriptionError as error:
        context.report.warn(error.at, f"{error.what}; {otherwise}", error.id)
        return None


_READERS: dict[str, Callable[[XmlNode, Context], Geometry]] = {
    "box": _box,
    "cylinder": _cylinder,
    "sphere": _sphere,
    "capsule": _capsule,
    "ellipsoid": _ellipsoid,
    "cone": _cone,
    "plane": _plane,
    "mesh": _mesh,
    "heightmap": _heightmap,
}
