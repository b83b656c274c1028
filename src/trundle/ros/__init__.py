"""The ROS 1 graph by itself: master, parameters, topics, services, tf and messages.

Names are imported on first use: a command that only asks the master pays for neither asyncio nor numpy.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .clock import Clock, SimClock, WallClock, follow_time, ns_of
    from .core import Core
    from .errors import (
        MasterError,
        MasterUnreachableError,
        MessageError,
        ParameterError,
        PortTakenError,
        RosError,
        ServiceError,
        TransformError,
    )
    from .loop import GraphLoop
    from .master import Master
    from .messages import Message, Messages, RawMessage, ServiceType
    from .network import master_uri_from_env
    from .node import Node
    from .parameters import ParameterTree, set_leaves
    from .printing import MessagePrinter, field_value
    from .proxy import MasterProxy, blocking_call
    from .publisher import Publisher
    from .service import Service, probe_service
    from .subscription import Subscription
    from .tf_buffer import Transform, TransformBuffer
    from .tf_nodes import StaticTransformBroadcaster, TransformBroadcaster, TransformListener

_HOMES = {
    "Clock": "clock",
    "Core": "core",
    "GraphLoop": "loop",
    "Master": "master",
    "MasterError": "errors",
    "MasterProxy": "proxy",
    "MasterUnreachableError": "errors",
    "Message": "messages",
    "MessageError": "errors",
    "MessagePrinter": "printing",
    "Messages": "messages",
    "Node": "node",
    "ParameterError": "errors",
    "ParameterTree": "parameters",
    "PortTakenError": "errors",
    "Publisher": "publisher",
    "RawMessage": "messages",
    "RosError": "errors",
    "Service": "service",
    "ServiceError": "errors",
    "ServiceType": "messages",
    "SimClock": "clock",
    "StaticTransformBroadcaster": "tf_nodes",
    "Subscription": "subscription",
    "Transform": "tf_buffer",
    "TransformBroadcaster": "tf_nodes",
    "TransformBuffer": "tf_buffer",
    "TransformError": "errors",
    "TransformListener": "tf_nodes",
    "WallClock": "clock",
    "blocking_call": "proxy",
    "field_value": "printing",
    "follow_time": "clock",
    "master_uri_from_env": "network",
    "ns_of": "clock",
    "probe_service": "service",
    "set_leaves": "parameters",
}


def __getattr__(name: str) -> Any:
    if name not in _HOMES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib import import_module

    value = getattr(import_module(f".{_HOMES[name]}", __name__), name)
    globals()[name] = value
    return value


__all__ = [
    "Clock",
    "Core",
    "GraphLoop",
    "Master",
    "MasterError",
    "MasterProxy",
    "MasterUnreachableError",
    "Message",
    "MessageError",
    "MessagePrinter",
    "Messages",
    "Node",
    "ParameterError",
    "ParameterTree",
    "PortTakenError",
    "Publisher",
    "RawMessage",
    "RosError",
    "Service",
    "ServiceError",
    "ServiceType",
    "SimClock",
    "StaticTransformBroadcaster",
    "Subscription",
    "Transform",
    "TransformBroadcaster",
    "TransformBuffer",
    "TransformError",
    "TransformListener",
    "WallClock",
    "blocking_call",
    "field_value",
    "follow_time",
    "master_uri_from_env",
    "ns_of",
    "probe_service",
    "set_leaves",
]
