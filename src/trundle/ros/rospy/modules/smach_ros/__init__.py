"""States for actions, services and topics, and introspection of running state machines."""

import rospy
import smach

from .action_server_wrapper import ActionServerWrapper
from .condition_state import ConditionState
from .introspection import IntrospectionClient, IntrospectionServer
from .monitor_state import MonitorState
from .service_state import ServiceState
from .simple_action_state import SimpleActionState
from .util import set_preempt_handler

__all__ = [
    "ActionServerWrapper",
    "ConditionState",
    "IntrospectionClient",
    "IntrospectionServer",
    "MonitorState",
    "ServiceState",
    "SimpleActionState",
    "set_preempt_handler",
]

smach.set_loggers(rospy.loginfo, rospy.logwarn, rospy.logdebug, rospy.logerr)
smach.set_shutdown_check(rospy.is_shutdown)
