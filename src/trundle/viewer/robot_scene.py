"""A URDF as rviz's RobotModel draws it: every link as written, nothing lumped."""

from trundle.diagnostics import Diagnostics
from trundle.model import Box, Cylinder, Rgba, Sphere
from trundle.render import Scene, Shape, ShapeGeometry
from trundle.robot import Robot, RobotBox, RobotCylinder, RobotMesh, RobotShape, RobotSphere

_UNPAINTED: Rgba = (1.0, 0.0, 0.0, 1.0)
"""rviz draws what has no material in red; the first robot of urdf_tutorial is known for it."""


def robot_scene(robot: Robot, report: Diagnostics, *, collisions: bool = False) -> Scene:
    """Turn a robot's visuals, or its collision shapes, into a scene whose bodies are the links, root first."""
    links = sorted(robot.links, key=lambda link: link.name != robot.root)  # stable: the others stay in file order
    shapes: list[Shape] = []
    for body, link in enumerate(links):
        for shape in link.collisions if collisions else link.visuals:
            geometry = _geometry(shape, report)
            if geometry is not None:
                shapes.append(
                    Shape(
                        name=shape.name or link.name,
                        body=body,
                        geometry=geometry,
                        body_from_shape=shape.link_from_shape,
                        rgba=shape.rgba or _UNPAINTED,
                    )
                )
    return Scene(bodies=tuple(link.name for link in links), shapes=tuple(shapes))


def _geometry(shape: RobotShape, report: Diagnostics) -> ShapeGeometry | None:
    match shape.geometry:
        case RobotBox(size):
            return Box(size)
        case RobotCylinder(radius, length):
            return Cylinder(radius, length)
        case RobotSphere(radius):
            return Sphere(radius)
        case RobotMesh(uri):
            report.warn(shape.at, f"{uri}: the page of a graph does not draw meshes yet; this shape is left out")
            return None
