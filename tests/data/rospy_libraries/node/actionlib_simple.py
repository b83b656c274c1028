"""SimpleActionServer and SimpleActionClient: success, abort, reject-like cancel, preemption, timeouts, callbacks."""

import threading

from actionlib_msgs.msg import GoalStatus
from tf2_msgs.msg import LookupTransformAction, LookupTransformGoal, LookupTransformResult

import actionlib
import rospy

rospy.init_node("simple_actions")
server_lock = threading.Lock()


def execute(goal):
    """Do as the goal's target frame says."""
    order = goal.target_frame
    result = LookupTransformResult()
    result.transform.child_frame_id = f"done {order}"
    if order == "succeed":
        server.set_succeeded(result, "well done")
    elif order == "abort":
        server.set_aborted(result, "no way")
    elif order == "raise":
        raise ValueError("broken callback")
    elif order == "forget":
        return
    elif order == "wait":
        while not server.is_preempt_requested() and not rospy.is_shutdown():
            rospy.sleep(0.01)
        server.set_preempted(result, "stopped")


server = actionlib.SimpleActionServer("act", LookupTransformAction, execute_cb=execute, auto_start=False)
server.start()
client = actionlib.SimpleActionClient("act", LookupTransformAction)
print("server", client.wait_for_server(rospy.Duration(30)))
print("state without goal", client.get_state() == GoalStatus.LOST)
for order in ("succeed", "abort", "raise", "forget"):
    state = client.send_goal_and_wait(LookupTransformGoal(target_frame=order))
    print(
        order, GoalStatus.to_string(state), client.get_goal_status_text(), client.get_result().transform.child_frame_id
    )

events = []
done = threading.Event()


def on_done(state, result):
    """Note the end."""
    events.append(("done", GoalStatus.to_string(state), result.transform.child_frame_id))
    done.set()


active = threading.Event()
client.send_goal(LookupTransformGoal(target_frame="wait"), done_cb=on_done, active_cb=active.set)
active.wait(30)
print("active", GoalStatus.to_string(client.get_state()), client.simple_state == actionlib.SimpleGoalState.ACTIVE)
print("not yet", client.wait_for_result(rospy.Duration(0.2)))
client.cancel_goal()
done.wait(30)
print(events)
client.wait_for_result()
print(client.get_state(), client.get_goal_status_text())

client.send_goal(LookupTransformGoal(target_frame="wait"))
while client.get_state() != GoalStatus.ACTIVE:
    rospy.sleep(0.01)
other = actionlib.SimpleActionClient("act", LookupTransformAction)
other.wait_for_server()
print("newer goal", GoalStatus.to_string(other.send_goal_and_wait(LookupTransformGoal(target_frame="succeed"))))
client.wait_for_result()
print("older goal", GoalStatus.to_string(client.get_state()), client.get_goal_status_text())
state = client.send_goal_and_wait(
    LookupTransformGoal(target_frame="wait"), execute_timeout=rospy.Duration(0.3), preempt_timeout=rospy.Duration(30)
)
print("timed out", GoalStatus.to_string(state))
client.stop_tracking_goal()
print(client.get_result(), client.wait_for_result(), client.get_goal_status_text())
print(actionlib.SimpleGoalState.to_string(1), actionlib.TerminalState.to_string(9), actionlib.CommState.to_string(99))
try:
    actionlib.SimpleActionClient("act", GoalStatus)
except actionlib.action_client.ActionException as error:
    print(type(error).__name__)
missing = actionlib.SimpleActionClient("nobody", LookupTransformAction)
print("nobody", missing.wait_for_server(rospy.Duration(0.3)))
rospy.signal_shutdown("done")
