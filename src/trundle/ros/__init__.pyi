from .bags import (
    TF_TYPES as TF_TYPES,
    BagConnection as BagConnection,
    BagError as BagError,
    BagMessage as BagMessage,
    BagReader as BagReader,
    BagSummary as BagSummary,
    BagWriter as BagWriter,
    FramePoses as FramePoses,
    Player as Player,
    PlayerOptions as PlayerOptions,
    RecordedNumbers as RecordedNumbers,
    RecordedTopic as RecordedTopic,
    Recorder as Recorder,
    RecorderOptions as RecorderOptions,
    StepRecorder as StepRecorder,
    TopicNumbers as TopicNumbers,
    UnindexedBagError as UnindexedBagError,
    byte_text as byte_text,
    create_bag as create_bag,
    is_bag as is_bag,
    median_rates as median_rates,
    message_time as message_time,
    open_bag as open_bag,
    read_numbers as read_numbers,
    recover_messages as recover_messages,
    replaced_bag as replaced_bag,
    transform_poses as transform_poses,
)
from .clients.action_client import ABORTED as ABORTED, SUCCEEDED as SUCCEEDED, ActionClient as ActionClient
from .clients.action_server import ActionResult as ActionResult, ActionServer as ActionServer
from .clients.reconfigure_client import (
    find_reconfigurable as find_reconfigurable,
    read_options as read_options,
    set_options as set_options,
)
from .clients.reconfigure_server import (
    Option as Option,
    Options as Options,
    OptionValue as OptionValue,
    ReconfigureServer as ReconfigureServer,
)
from .clients.tf_buffer import TransformBuffer as TransformBuffer
from .clients.tf_nodes import (
    StaticTransformBroadcaster as StaticTransformBroadcaster,
    TransformBroadcaster as TransformBroadcaster,
    TransformListener as TransformListener,
)
from .clients.topic_meters import BandwidthMeter as BandwidthMeter, DelayMeter as DelayMeter, RateMeter as RateMeter
from .clients.topic_series import (
    TopicSeries as TopicSeries,
    recent_curves as recent_curves,
    spread_fields as spread_fields,
    subscribe_series as subscribe_series,
)
from .clients.transform_history import Transform as Transform
from .clients.transform_tree import check_frame_name as check_frame_name
from .core.logs import (
    PYTHON_LOG_BACKUPS as PYTHON_LOG_BACKUPS,
    PYTHON_LOG_BYTES as PYTHON_LOG_BYTES,
    python_log_line as python_log_line,
)
from .core.roscore import Core as Core
from .distro import DISTROS as DISTROS, NOETIC as NOETIC, Distro as Distro
from .errors import (
    ConnectivityError as ConnectivityError,
    ExtrapolationError as ExtrapolationError,
    FrameNameError as FrameNameError,
    MasterError as MasterError,
    MasterUnreachableError as MasterUnreachableError,
    MessageError as MessageError,
    ParameterError as ParameterError,
    PortTakenError as PortTakenError,
    RosError as RosError,
    ServiceError as ServiceError,
    TransformError as TransformError,
)
from .log import LEVELS as LEVELS, colored as colored
from .log_file import LogFile as LogFile
from .master.master_api import Master as Master
from .master.parameters import ParameterTree as ParameterTree, set_leaves as set_leaves
from .messages.field_paths import (
    TopicField as TopicField,
    field_type as field_type,
    split_topic as split_topic,
    value_at as value_at,
)
from .messages.genpy_view import MessageView as MessageView
from .messages.message_library import Messages as Messages
from .messages.numbers import Layout as Layout, NumberReader as NumberReader
from .messages.printing import MessagePrinter as MessagePrinter, field_value as field_value
from .messages.raw_message import Message as Message, RawMessage as RawMessage, ServiceType as ServiceType
from .migration import (
    GeneratedRule as GeneratedRule,
    MessageClass as MessageClass,
    MessageClasses as MessageClasses,
    MigrationError as MigrationError,
    MigrationStep as MigrationStep,
    Migrator as Migrator,
    PlaceholderRule as PlaceholderRule,
    Rule as Rule,
    RuleFile as RuleFile,
    missing_rules as missing_rules,
)
from .node.callback_dispatch import Deliver as Deliver
from .node.clock import Clock as Clock, SimClock as SimClock, WallClock as WallClock, to_nsec as to_nsec
from .node.endpoint_recorder import Endpoint as Endpoint
from .node.graph_node import Node as Node
from .node.loggers import Loggers as Loggers
from .node.loop import GraphLoop as GraphLoop
from .node.pending_work import PendingWork as PendingWork, WorkItem as WorkItem
from .node.publisher import Publisher as Publisher
from .node.publisher_probe import probe_publisher as probe_publisher
from .node.service import Service as Service
from .node.service_client import call_service_bytes as call_service_bytes, probe_service as probe_service
from .node.subscription import Subscription as Subscription
from .node.use_sim_time import follow_time as follow_time
from .transport.network import master_uri_from_env as master_uri_from_env, server_address as server_address
from .xmlrpc.http import host_and_port as host_and_port, uri_host as uri_host
from .xmlrpc.proxy import MasterProxy as MasterProxy, blocking_call as blocking_call
from .xmlrpc.rpc_server import RpcServer as RpcServer, UnknownMethodError as UnknownMethodError
