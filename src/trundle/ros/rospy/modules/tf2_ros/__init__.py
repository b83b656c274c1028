"""tf2 on the ROS graph: buffer, listener, broadcasters, and the client of a buffer server."""

from actionlib_msgs.msg import GoalStatus
from geometry_msgs.msg import TransformStamped
from std_msgs.msg import Header
from tf2_msgs.msg import LookupTransformAction, LookupTransformGoal, TFMessage
from tf2_msgs.srv import FrameGraph, FrameGraphResponse

from tf2_py import (
    BufferCore,
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TimeoutException,
    TransformException,
)

from .buffer import DEFAULT_CAN_TRANSFORM_POLLING_SCALE, Buffer
from .buffer_client import BufferClient
from .buffer_interface import BufferInterface, Stamped
from .registration import (
    ConvertRegistration,
    NotImplementedException,
    TransformRegistration,
    TypeException,
    convert,
)
from .static_transform_broadcaster import StaticTransformBroadcaster
from .transform_broadcaster import TransformBroadcaster
from .transform_listener import TransformListener

__all__ = [
    "DEFAULT_CAN_TRANSFORM_POLLING_SCALE",
    "Buffer",
    "BufferClient",
    "BufferCore",
    "BufferInterface",
    "ConnectivityException",
    "ConvertRegistration",
    "ExtrapolationException",
    "FrameGraph",
    "FrameGraphResponse",
    "GoalStatus",
    "Header",
    "InvalidArgumentException",
    "LookupException",
    "LookupTransformAction",
    "LookupTransformGoal",
    "NotImplementedException",
    "Stamped",
    "StaticTransformBroadcaster",
    "TFMessage",
    "TimeoutException",
    "TransformBroadcaster",
    "TransformException",
    "TransformListener",
    "TransformRegistration",
    "TransformStamped",
    "TypeException",
    "convert",
]
