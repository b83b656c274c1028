"""Preemption at shutdown."""

import rospy
import rospy.core
import smach


def set_preempt_handler(sc: smach.StateMachine) -> None:
    """Preempt a state machine when the node shuts down, and wait for its end."""

    def handler() -> None:
        sc.request_preempt()
        while sc.is_running():
            rospy.loginfo("shutting down: waiting for the state machine to end")
            rospy.rostime.wallsleep(1.0)

    rospy.core.add_client_shutdown_hook(lambda *_: handler())
