"""Interface of transform lookups, and transformation of stamped data by them."""

from typing import Any

from std_msgs.msg import Header

import genpy
import rospy

from .registration import (
    ConvertRegistration,
    NotImplementedException,
    TransformRegistration,
    TypeException,
    convert,
)

__all__ = [
    "BufferInterface",
    "ConvertRegistration",
    "NotImplementedException",
    "Stamped",
    "TransformRegistration",
    "TypeException",
    "convert",
]

_NO_WAIT = rospy.Duration(0.0)


class BufferInterface:
    """Base class of Buffer and BufferClient."""

    def __init__(self) -> None:
        self.registration = TransformRegistration()

    def transform(
        self, object_stamped: Any, target_frame: str, timeout: genpy.Duration = _NO_WAIT, new_type: Any = None
    ) -> Any:
        """Transform data with a header into a frame, at the header's time.

        Args:
            object_stamped: instance of a registered type.
            target_frame: frame of the result.
            timeout: rospy.Duration to wait for the transform.
            new_type: type to convert the result to.

        Raises:
            TypeException: the type is not registered.
            tf2_ros.TransformException: there is no such transform.
        """
        transform_type = self.registration.get(type(object_stamped))
        header = object_stamped.header
        transform = self.lookup_transform(target_frame, header.frame_id, header.stamp, timeout)
        result = transform_type(object_stamped, transform)
        return convert(result, new_type) if new_type else result

    def transform_full(
        self,
        object_stamped: Any,
        target_frame: str,
        target_time: genpy.Time,
        fixed_frame: str,
        timeout: genpy.Duration = _NO_WAIT,
        new_type: Any = None,
    ) -> Any:
        """Transform data with a header into a frame at another time; see `transform`."""
        transform_type = self.registration.get(type(object_stamped))
        header = object_stamped.header
        transform = self.lookup_transform_full(
            target_frame, target_time, header.frame_id, header.stamp, fixed_frame, timeout
        )
        result = transform_type(object_stamped, transform)
        return convert(result, new_type) if new_type else result

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: genpy.Time, timeout: genpy.Duration = _NO_WAIT
    ) -> Any:
        """TransformStamped of the source in the target frame."""
        raise NotImplementedException

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: genpy.Time,
        source_frame: str,
        source_time: genpy.Time,
        fixed_frame: str,
        timeout: genpy.Duration = _NO_WAIT,
    ) -> Any:
        """TransformStamped between two frames at two times."""
        raise NotImplementedException

    def can_transform(
        self, target_frame: str, source_frame: str, time: genpy.Time, timeout: genpy.Duration = _NO_WAIT
    ) -> Any:
        """True if `lookup_transform` would succeed."""
        raise NotImplementedException

    def can_transform_full(
        self,
        target_frame: str,
        target_time: genpy.Time,
        source_frame: str,
        source_time: genpy.Time,
        fixed_frame: str,
        timeout: genpy.Duration = _NO_WAIT,
    ) -> Any:
        """True if `lookup_transform_full` would succeed."""
        raise NotImplementedException


def Stamped(obj: Any, stamp: genpy.Time, frame_id: str) -> Any:
    """Give an object a header."""
    obj.header = Header(frame_id=frame_id, stamp=stamp)
    return obj
