"""Reads <geometry>."""

from trundle.diagnostics import DescriptionError
from trundle.model import Box, Capsule, Cylinder, Ellipsoid, Geometry, MeshFile, Plane, Sphere
from trundle.spatial import normalized
from trundle.xmlnode import XmlNode

from .context import Context

_KNOWN = ("box", "cylinder", "sphere", "capsule", "ellipsoid", "plane", "mesh")
_UNSUPPORTED = ("heightmap", "polyline", "image", "cone", "voxel_grid")


def read_geometry(owner: XmlNode, context: Context) -> Geometry | None:
    """The shape of a visual or collision; None, after a warning, where it is none we have."""
    node = owner.find("geometry")
    report = context.report
    if node is None:
        report.warn(owner.at, f"<{owner.tag}> without <geometry>; it is left out")
        return None
    node.find("empty")
    for tag in _UNSUPPORTED:
        shape = node.find(tag)
        if shape is not None:
            report.warn(shape.at, f"<{tag}> is not supported; this <{owner.tag}> is left out")
            shape.mark_all_read()
            return None
    for tag in _KNOWN:
        shape = node.find(tag)
        if shape is not None:
            geometry = _shape(tag, shape, context)
            shape.report_unread(report)
            node.report_unread(report)
            return geometry
    node.report_unread(report)
    return None


def _shape(tag: str, shape: XmlNode, context: Context) -> Geometry | None:
    report = context.report
    match tag:
        case "box":
            return Box(shape.vector("size", default=(1.0, 1.0, 1.0), report=report))
        case "cylinder":
            return Cylinder(
                shape.number("radius", default=1.0, report=report), shape.number("length", default=1.0, report=report)
            )
        case "capsule":
            return Capsule(
                shape.number("radius", default=0.5, report=report), shape.number("length", default=1.0, report=report)
            )
        case "sphere":
            return Sphere(shape.number("radius", default=1.0, report=report))
        case "ellipsoid":
            return Ellipsoid(shape.vector("radii", default=(1.0, 1.0, 1.0), report=report))
        case "plane":
            return _plane(shape, context)
        case _:
            return _mesh(shape, context)


def _plane(shape: XmlNode, context: Context) -> Plane:
    written = shape.vector("normal", default=(0.0, 0.0, 1.0), report=context.report)
    normal = normalized(written)
    if normal is None:
        context.report.warn(shape.at, "<plane> with a normal of no length; 0 0 1 is used")
        normal = (0.0, 0.0, 1.0)
    size = shape.find("size")
    values = None if size is None else size.as_numbers(2, report=context.report, fallback="1 1 is used")
    return Plane(normal, (1.0, 1.0) if values is None else (values[0], values[1]))


def _mesh(shape: XmlNode, context: Context) -> MeshFile | None:
    uri = shape.string("uri")
    if not uri:
        context.report.warn(shape.at, "<mesh> without <uri>; it is left out")
        return None
    scale = shape.vector("scale", default=(1.0, 1.0, 1.0), report=context.report)
    part = shape.find("submesh")
    name = part.string("name") if part is not None else None
    center = part.flag("center", default=False, report=context.report) if part is not None else False
    try:
        path = context.packages.resolve(uri, beside=context.folder, at=shape.at)
    except DescriptionError as error:
        context.report.warn(error.at, f"{error.what}; the mesh is left out")
        return None
    return MeshFile(path=path, uri=uri, scale=scale, submesh=name or None, center_submesh=center)
