"""Markers of a robot's links, as rviz shows them."""

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
from visualization_msgs.msg import Marker

import rospy
from trundle.robots.robot import RobotBox, RobotCylinder, RobotMesh, RobotSphere
from trundle.spatial import Pose

if TYPE_CHECKING:
    from .robot_state import SharedRobot

_GRAY = (0.5, 0.5, 0.5, 1.0)


def link_markers(robot: "SharedRobot", positions: np.ndarray, links: Iterable[str]) -> list[Any]:
    """Return a marker for each visual of some links, in the model's frame."""
    wanted = set(links)
    markers: list[Any] = []
    for link in robot.model.urdf.links:
        if link.name not in wanted:
            continue
        x, y, z, qx, qy, qz, qw = robot.link_pose(positions, link.name)
        model_from_link = Pose((x, y, z), (qw, qx, qy, qz))
        for visual in link.visuals:
            marker = _marker(visual.geometry)
            marker.header.frame_id = robot.model.model_frame
            marker.header.stamp = rospy.get_rostime()
            marker.ns, marker.id = link.name, len(markers)
            pose = model_from_link @ visual.link_from_shape
            p, q = marker.pose.position, marker.pose.orientation
            p.x, p.y, p.z = pose.position
            q.w, q.x, q.y, q.z = pose.quaternion
            c = marker.color
            c.r, c.g, c.b, c.a = visual.rgba or _GRAY
            markers.append(marker)
    return markers


def _marker(geometry: object) -> Any:
    marker = Marker()
    match geometry:
        case RobotBox(size=size):
            marker.type, scale = Marker.CUBE, size
        case RobotCylinder(radius=radius, length=length):
            marker.type, scale = Marker.CYLINDER, (2.0 * radius, 2.0 * radius, length)
        case RobotSphere(radius=radius):
            marker.type, scale = Marker.SPHERE, (2.0 * radius,) * 3
        case RobotMesh(uri=uri, scale=scale):
            marker.type, marker.mesh_resource = Marker.MESH_RESOURCE, uri
            marker.mesh_use_embedded_materials = True
        case _:
            scale = (1.0, 1.0, 1.0)
    marker.scale.x, marker.scale.y, marker.scale.z = scale
    return marker
