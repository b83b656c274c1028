"""Which points of a sensor are the robot itself, or what it carries."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from trundle.robots.meshes import Mesh
from trundle.robots.model import Box, Cone, Cylinder, Sphere
from trundle.robots.robot import RobotBox, RobotCylinder, RobotMesh, RobotSphere
from trundle.spatial import Pose

if TYPE_CHECKING:
    from trundle.planning.robot_model import RobotModel

_MESH_REACH_M = 0.15
"""Half length of the box that stands for a mesh whose file is not read here [m]."""


class RobotFilter:
    """Boxes around the shapes of links, widened."""

    def __init__(self, model: "RobotModel", padding: float, scale: float) -> None:
        """Take the links' collision shapes.

        Args:
            model: robot.
            padding: added on each side [m].
            scale: factor of the lengths.
        """
        self._padding, self._scale = padding, scale
        self._boxes = [
            (link.name, shape.link_from_shape, _half_lengths(shape.geometry))
            for link in model.urdf.links
            for shape in link.collisions
        ]

    def mask(self, points: NDArray[np.float64], poses: Mapping[str, Pose], carried: Sequence[Any]) -> NDArray[np.bool_]:
        """Return True for the points (n, 3) in the model's frame that are inside a box.

        Args:
            points: [m]
            poses: link → pose.
            carried: attached objects.
        """
        inside = np.zeros(len(points), dtype=np.bool_)
        boxes = [(poses[name] @ pose, half) for name, pose, half in self._boxes]
        boxes += [
            (poses[one.link] @ one.object.pose @ shape.pose, _half_lengths(shape.geometry))
            for one in carried
            for shape in one.object.shapes
        ]
        for pose, half in boxes:
            back = pose.inverse()
            axes = np.array([back.transform_vector(axis) for axis in ((1, 0, 0), (0, 1, 0), (0, 0, 1))])
            local = points @ axes + np.array(back.position)
            inside |= np.all(np.abs(local) <= np.array(half) * self._scale + self._padding, axis=1)
        return inside


def _half_lengths(geometry: object) -> tuple[float, float, float]:
    match geometry:
        case RobotBox(size=(x, y, z)) | Box(size=(x, y, z)):
            return (x / 2.0, y / 2.0, z / 2.0)
        case RobotCylinder(radius=radius, length=length) | Cylinder(radius=radius, length=length):
            return (radius, radius, length / 2.0)
        case Cone(radius=radius, length=length):
            return (radius, radius, length / 2.0)
        case RobotSphere(radius=radius) | Sphere(radius=radius):
            return (radius, radius, radius)
        case Mesh(vertices=vertices):
            x, y, z = np.abs(vertices).max(axis=0).tolist()
            return (x, y, z)
        case RobotMesh():
            return (_MESH_REACH_M, _MESH_REACH_M, _MESH_REACH_M)
        case _:
            return (0.0, 0.0, 0.0)
