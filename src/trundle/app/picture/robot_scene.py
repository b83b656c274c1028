"""Scene of a URDF as rviz's RobotModel draws it: every link as written, without merging fixed ones."""

from pathlib import Path

from trundle.base.diagnostics import Diagnostics, TrundleError
from trundle.robots.meshes import Mesh, load_mesh, mean_color
from trundle.robots.model import Box, Cylinder, Rgba, Sphere
from trundle.robots.packages import Packages
from trundle.robots.robot import Robot, RobotBox, RobotCylinder, RobotMesh, RobotShape, RobotSphere
from trundle.sim.render import Scene, Shape, ShapeGeometry

_NO_MATERIAL: Rgba = (1.0, 0.0, 0.0, 1.0)
"""rviz draws shapes without a material in red, as in the first robot of urdf_tutorial."""


def robot_scene(robot: Robot, packages: Packages, report: Diagnostics, *, collisions: bool = False) -> Scene:
    """Return a scene of a robot's visuals, or its collision shapes; its bodies are the links, root first.

    A mesh that cannot be found or read is reported and left out.
    """
    links = sorted(robot.links, key=lambda link: link.name != robot.root)  # stable: others stay in file order
    shapes: list[Shape] = []
    for body, link in enumerate(links):
        for shape in link.collisions if collisions else link.visuals:
            geometry = _geometry(shape, packages, report)
            if geometry is None:
                continue
            rgba = shape.rgba or _texture_color(shape, packages, report)
            shapes += (
                Shape(
                    name=shape.name or link.name,
                    body=body,
                    geometry=part,
                    body_from_shape=shape.link_from_shape,
                    rgba=rgba or (part.rgba if isinstance(part, Mesh) else None) or _NO_MATERIAL,
                )
                for part in (
                    geometry.split_by_material() if isinstance(geometry, Mesh) and rgba is None else (geometry,)
                )
            )
    return Scene(bodies=tuple(link.name for link in links), shapes=tuple(shapes))


def _texture_color(shape: RobotShape, packages: Packages, report: Diagnostics) -> Rgba | None:
    """Return the mean color of a shape's texture, since the page draws no textures."""
    if not shape.texture:
        return None
    try:
        image = packages.resolve(shape.texture, folder=Path(shape.at.file).parent, at=shape.at)
    except TrundleError as error:
        report.warn_error(error, shape.at, "the texture is left out", "texture")
        return None
    return mean_color(image)


def _geometry(shape: RobotShape, packages: Packages, report: Diagnostics) -> ShapeGeometry | None:
    match shape.geometry:
        case RobotBox(size):
            return Box(size)
        case RobotCylinder(radius, length):
            return Cylinder(radius, length)
        case RobotSphere(radius):
            return Sphere(radius)
        case RobotMesh(uri, scale):
            try:
                mesh = load_mesh(packages.resolve(uri, folder=Path(shape.at.file).parent, at=shape.at))
            except TrundleError as error:
                report.warn_error(error, shape.at, "this shape is not drawn", "mesh")
                return None
            return mesh.scaled(scale)
