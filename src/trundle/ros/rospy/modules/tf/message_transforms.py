"""Transformation of stamped messages into a frame."""

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import geometry_msgs.msg
import numpy
import sensor_msgs.msg

from . import transformations

if TYPE_CHECKING:
    from numpy.typing import NDArray

    import genpy


def xyz_to_mat44(pos: Any) -> "NDArray[numpy.float64]":
    """4×4 translation by a message with x, y, z."""
    return transformations.translation_matrix((pos.x, pos.y, pos.z))


def xyzw_to_mat44(ori: Any) -> "NDArray[numpy.float64]":
    """4×4 rotation of a message with x, y, z, w."""
    return transformations.quaternion_matrix((ori.x, ori.y, ori.z, ori.w))


class MessageTransforms:
    """Transforms of messages, by `lookupTransform` of the class it is mixed into.

    Each method returns a new message in the target frame with the original stamp, and raises the exceptions of
    `lookupTransform`.
    """

    if TYPE_CHECKING:

        def lookupTransform(
            self, target_frame: str, source_frame: str, time: genpy.Time
        ) -> tuple[list[float], list[float]]: ...

    def asMatrix(self, target_frame: str, hdr: Any) -> "NDArray[numpy.float64]":
        """4×4 transform from a header's frame, at its time."""
        return self.fromTranslationRotation(*self.lookupTransform(target_frame, hdr.frame_id, hdr.stamp))

    def fromTranslationRotation(
        self, translation: "Sequence[float]", rotation: "Sequence[float]"
    ) -> "NDArray[numpy.float64]":
        """4×4 transform of a translation (x, y, z) and a rotation (x, y, z, w)."""
        return numpy.dot(transformations.translation_matrix(translation), transformations.quaternion_matrix(rotation))

    def transformPoint(self, target_frame: str, ps: Any) -> Any:
        """Transform a PointStamped."""
        result = _stamped(geometry_msgs.msg.PointStamped, target_frame, ps)
        moved = self.asMatrix(target_frame, ps.header) @ (ps.point.x, ps.point.y, ps.point.z, 1.0)
        result.point = geometry_msgs.msg.Point(*moved[:3])
        return result

    def transformVector3(self, target_frame: str, v3s: Any) -> Any:
        """Rotate a Vector3Stamped."""
        result = _stamped(geometry_msgs.msg.Vector3Stamped, target_frame, v3s)
        rotation = self.asMatrix(target_frame, v3s.header)[:3, :3]
        result.vector = geometry_msgs.msg.Vector3(*(rotation @ (v3s.vector.x, v3s.vector.y, v3s.vector.z)))
        return result

    def transformQuaternion(self, target_frame: str, ps: Any) -> Any:
        """Rotate a QuaternionStamped."""
        result = _stamped(geometry_msgs.msg.QuaternionStamped, target_frame, ps)
        turned = self.asMatrix(target_frame, ps.header) @ xyzw_to_mat44(ps.quaternion)
        result.quaternion = geometry_msgs.msg.Quaternion(*transformations.quaternion_from_matrix(turned))
        return result

    def transformPose(self, target_frame: str, ps: Any) -> Any:
        """Transform a PoseStamped."""
        result = _stamped(geometry_msgs.msg.PoseStamped, target_frame, ps)
        pose = xyz_to_mat44(ps.pose.position) @ xyzw_to_mat44(ps.pose.orientation)
        moved = self.asMatrix(target_frame, ps.header) @ pose
        result.pose.position = geometry_msgs.msg.Point(*moved[:3, 3])
        result.pose.orientation = geometry_msgs.msg.Quaternion(*transformations.quaternion_from_matrix(moved))
        return result

    def transformPointCloud(self, target_frame: str, point_cloud: Any) -> Any:
        """Transform a PointCloud; the result shares its channels."""
        result = _stamped(sensor_msgs.msg.PointCloud, target_frame, point_cloud)
        result.channels = point_cloud.channels
        matrix = self.asMatrix(target_frame, point_cloud.header)
        points = numpy.array([(p.x, p.y, p.z) for p in point_cloud.points]).reshape(-1, 3)
        moved = points @ matrix[:3, :3].T + matrix[:3, 3]
        result.points = [geometry_msgs.msg.Point(*point) for point in moved.tolist()]
        return result


def _stamped(message_type: Callable[[], Any], frame: str, source: Any) -> Any:
    message = message_type()
    message.header.stamp = source.header.stamp
    message.header.frame_id = frame
    return message
