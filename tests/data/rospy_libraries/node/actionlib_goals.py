"""ActionServer and ActionClient: many goals, transitions, feedback, cancel by ID, time and all."""

import threading

from actionlib_msgs.msg import GoalStatus
from tf2_msgs.msg import LookupTransformAction, LookupTransformFeedback, LookupTransformGoal

import actionlib
import rospy

rospy.init_node("many_actions")
handles = {}
arrived = threading.Semaphore(0)
canceled = []


def on_goal(handle):
    """Keep the handle under its name."""
    handles[handle.get_goal().target_frame] = handle
    arrived.release()


def on_cancel(handle):
    """End it."""
    canceled.append(handle.get_goal().target_frame)
    handle.set_canceled(None, "as asked")


server = actionlib.ActionServer("many", LookupTransformAction, on_goal, on_cancel, auto_start=False)
server.start()
client = actionlib.ActionClient("many", LookupTransformAction)
print(client.wait_for_server(rospy.Duration(30)))
paths, feedbacks, ends = {}, [], threading.Semaphore(0)


def send(name):
    """Send a goal and note the states it goes through."""
    path = paths.setdefault(name, [])

    def on_transition(handle):
        path.append(actionlib.CommState.to_string(handle.get_comm_state()))
        if path[-1] == "DONE":
            ends.release()

    def on_feedback(handle, feedback):
        feedbacks.append((type(handle).__name__, type(feedback).__name__))

    goal_handle = client.send_goal(LookupTransformGoal(target_frame=name), on_transition, on_feedback)
    arrived.acquire(timeout=30)
    return goal_handle


def wait_state(handle, state):
    """Wait until the client knows."""
    while handle.get_comm_state() != state:
        rospy.sleep(0.01)


a = send("a")
wait_state(a, actionlib.CommState.PENDING)
handles["a"].set_accepted("go")
wait_state(a, actionlib.CommState.ACTIVE)
handles["a"].publish_feedback(LookupTransformFeedback())
while not feedbacks:
    rospy.sleep(0.01)
handles["a"].set_succeeded(None, "good")
ends.acquire(timeout=30)
print(paths["a"], feedbacks, actionlib.TerminalState.to_string(a.get_terminal_state()), a.get_goal_status_text())
print(type(a.get_result()).__name__, a == a, a != a, a == send("b"))
handles["b"].set_rejected(None, "never")
ends.acquire(timeout=30)
print(paths["b"])
c = send("c")
wait_state(c, actionlib.CommState.PENDING)
c.cancel()
ends.acquire(timeout=30)
print(GoalStatus.to_string(c.get_goal_status()), canceled)
d, e = send("d"), send("e")
handles["d"].set_accepted()
client.cancel_all_goals()
ends.acquire(timeout=30)
ends.acquire(timeout=30)
print(sorted(canceled), GoalStatus.to_string(d.get_goal_status()), GoalStatus.to_string(e.get_goal_status()))
f = send("f")
client.cancel_goals_at_and_before_time(rospy.Time.now())
ends.acquire(timeout=30)
print(sorted(canceled), f.get_goal_status_text())
handles["f"].set_succeeded()
print(
    GoalStatus.to_string(handles["f"].get_goal_status().status), handles["f"].get_goal_id() == handles["f"].goal.goal_id
)
print(handles["a"] == handles["a"], handles["a"] == handles["b"], handles["a"] != handles["b"])
