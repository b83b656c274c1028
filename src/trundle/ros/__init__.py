"""The ROS 1 graph by itself: master, parameters, topics, services, tf and messages.

Names are imported on first use: a command that only asks the master pays for neither asyncio nor numpy.
"""

from typing import TYPE_CHECKING

from trundle.doors import opened_on_use

if TYPE_CHECKING:
    from .action_server import ActionOutcome, ActionServer
    from .bags import (
        BagConnection,
        BagError,
        BagMessage,
        BagReader,
        BagWriter,
        Player,
        PlayOptions,
        Recorder,
        RecordOptions,
        StepRecorder,
        UnindexedBagError,
        create_bag,
        open_bag,
        recovered,
    )
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
    from .fields import Field, field_type, split_topic, value_at
    from .log import LEVELS, coloured
    from .loop import GraphLoop
    from .master import Master
    from .messages import Message, Messages, RawMessage, ServiceType
    from .network import master_uri_from_env, server_address
    from .node import Node
    from .noted import End
    from .parameters import ParameterTree, set_leaves
    from .printing import MessagePrinter, field_value
    from .profile import NOETIC, PROFILES, Profile
    from .proxy import MasterProxy, blocking_call
    from .publisher import Publisher
    from .reconfigure import Option, Options, OptionValue, ReconfigureServer
    from .reconfigure_client import find_reconfigurable, read_options, set_options
    from .rpc_server import RpcServer, UnknownMethodError
    from .service import Service, probe_service
    from .settings import SettingError, Settings
    from .subscription import Subscription
    from .tf_buffer import Transform, TransformBuffer
    from .tf_nodes import StaticTransformBroadcaster, TransformBroadcaster, TransformListener
    from .traces import Trace, curves_of, follow_trace, spread_fields
    from .views import MessageView

_HOMES = {
    "ActionOutcome": "action_server",
    "ActionServer": "action_server",
    "BagConnection": "bags",
    "BagError": "bags",
    "BagMessage": "bags",
    "BagReader": "bags",
    "BagWriter": "bags",
    "Clock": "clock",
    "Core": "core",
    "End": "noted",
    "Field": "fields",
    "GraphLoop": "loop",
    "LEVELS": "log",
    "Master": "master",
    "MasterError": "errors",
    "MasterProxy": "proxy",
    "MasterUnreachableError": "errors",
    "Message": "messages",
    "MessageError": "errors",
    "MessagePrinter": "printing",
    "MessageView": "views",
    "Messages": "messages",
    "NOETIC": "profile",
    "Node": "node",
    "Option": "reconfigure",
    "OptionValue": "reconfigure",
    "Options": "reconfigure",
    "PROFILES": "profile",
    "ParameterError": "errors",
    "ParameterTree": "parameters",
    "PlayOptions": "bags",
    "Player": "bags",
    "PortTakenError": "errors",
    "Profile": "profile",
    "Publisher": "publisher",
    "RawMessage": "messages",
    "ReconfigureServer": "reconfigure",
    "RecordOptions": "bags",
    "Recorder": "bags",
    "RosError": "errors",
    "RpcServer": "rpc_server",
    "Service": "service",
    "ServiceError": "errors",
    "ServiceType": "messages",
    "SettingError": "settings",
    "Settings": "settings",
    "SimClock": "clock",
    "StaticTransformBroadcaster": "tf_nodes",
    "StepRecorder": "bags",
    "Subscription": "subscription",
    "Trace": "traces",
    "Transform": "tf_buffer",
    "TransformBroadcaster": "tf_nodes",
    "TransformBuffer": "tf_buffer",
    "TransformError": "errors",
    "TransformListener": "tf_nodes",
    "UnindexedBagError": "bags",
    "UnknownMethodError": "rpc_server",
    "WallClock": "clock",
    "blocking_call": "proxy",
    "coloured": "log",
    "create_bag": "bags",
    "curves_of": "traces",
    "field_type": "fields",
    "field_value": "printing",
    "find_reconfigurable": "reconfigure_client",
    "follow_time": "clock",
    "follow_trace": "traces",
    "master_uri_from_env": "network",
    "ns_of": "clock",
    "open_bag": "bags",
    "probe_service": "service",
    "read_options": "reconfigure_client",
    "recovered": "bags",
    "server_address": "network",
    "set_leaves": "parameters",
    "set_options": "reconfigure_client",
    "split_topic": "fields",
    "spread_fields": "traces",
    "value_at": "fields",
}
__getattr__ = opened_on_use(__name__, _HOMES)

__all__ = [
    "LEVELS",
    "NOETIC",
    "PROFILES",
    "ActionOutcome",
    "ActionServer",
    "BagConnection",
    "BagError",
    "BagMessage",
    "BagReader",
    "BagWriter",
    "Clock",
    "Core",
    "End",
    "Field",
    "GraphLoop",
    "Master",
    "MasterError",
    "MasterProxy",
    "MasterUnreachableError",
    "Message",
    "MessageError",
    "MessagePrinter",
    "MessageView",
    "Messages",
    "Node",
    "Option",
    "OptionValue",
    "Options",
    "ParameterError",
    "ParameterTree",
    "PlayOptions",
    "Player",
    "PortTakenError",
    "Profile",
    "Publisher",
    "RawMessage",
    "ReconfigureServer",
    "RecordOptions",
    "Recorder",
    "RosError",
    "RpcServer",
    "Service",
    "ServiceError",
    "ServiceType",
    "SettingError",
    "Settings",
    "SimClock",
    "StaticTransformBroadcaster",
    "StepRecorder",
    "Subscription",
    "Trace",
    "Transform",
    "TransformBroadcaster",
    "TransformBuffer",
    "TransformError",
    "TransformListener",
    "UnindexedBagError",
    "UnknownMethodError",
    "WallClock",
    "blocking_call",
    "coloured",
    "create_bag",
    "curves_of",
    "field_type",
    "field_value",
    "find_reconfigurable",
    "follow_time",
    "follow_trace",
    "master_uri_from_env",
    "ns_of",
    "open_bag",
    "probe_service",
    "read_options",
    "recovered",
    "server_address",
    "set_leaves",
    "set_options",
    "split_topic",
    "spread_fields",
    "value_at",
]
