"""smach_ros: action, service, monitor and condition states, action server wrapper, introspection."""

from actionlib_msgs.msg import GoalStatus
from smach_msgs.msg import SmachContainerStatus, SmachContainerStructure
from std_msgs.msg import Int32
from tf2_msgs.msg import LookupTransformAction, LookupTransformGoal, LookupTransformResult
from tf2_msgs.srv import FrameGraph, FrameGraphResponse

import actionlib
import rospy
import smach
import smach_ros

rospy.init_node("smach_states", log_level=rospy.FATAL)
smach.set_loggers(*[lambda text: None] * 4)


def execute(goal):
    """Do as the goal says."""
    result = LookupTransformResult()
    result.transform.child_frame_id = f"did {goal.target_frame}"
    if goal.target_frame == "fail":
        server.set_aborted(result)
    elif goal.target_frame == "long":
        while not server.is_preempt_requested():
            rospy.sleep(0.02)
        server.set_preempted(result)
    else:
        server.set_succeeded(result)


server = actionlib.SimpleActionServer("work", LookupTransformAction, execute, False)
server.start()
service = rospy.Service("frames", FrameGraph, lambda request: FrameGraphResponse("tree"))
numbers = rospy.Publisher("numbers", Int32, queue_size=10, latch=True)
numbers.publish(7)


@smach.cb_interface(input_keys=["frame"], output_keys=["saved"], outcomes=["special"])
def on_result(userdata, status, result):
    """Keep the result."""
    userdata.saved = (userdata.frame, GoalStatus.to_string(status), result.transform.child_frame_id)
    return "special" if result.transform.child_frame_id == "did it" else None


def run(state, outcomes, **userdata):
    """Outcome of one state in a machine, and the userdata after it."""
    machine = smach.StateMachine(outcomes)
    for key, value in userdata.items():
        machine.userdata[key] = value
    with machine:
        smach.StateMachine.add("ONLY", state)
    return machine.execute(), machine.userdata


ENDS = ["succeeded", "aborted", "preempted"]
Action = smach_ros.SimpleActionState
outcome, data = run(
    Action("work", LookupTransformAction, goal=LookupTransformGoal(target_frame="a"), result_key="r"), ENDS
)
print(outcome, data.r.transform.child_frame_id)
print(run(Action("work", LookupTransformAction, goal=LookupTransformGoal(target_frame="fail")), ENDS)[0])
outcome, data = run(
    Action("work", LookupTransformAction, goal_slots=["target_frame"], result_slots=["transform"]),
    ENDS,
    target_frame="slot",
)
print(outcome, data.transform.child_frame_id)
outcome, data = run(
    Action("work", LookupTransformAction, goal_cb=lambda ud, goal: LookupTransformGoal(target_frame=ud.frame),
           result_cb=on_result, input_keys=["frame"]),
    [*ENDS, "special"], frame="it",
)  # fmt: skip
print(outcome, data.saved)
long = Action("work", LookupTransformAction, goal=LookupTransformGoal(target_frame="long"))
rospy.Timer(rospy.Duration(0.5), lambda event: long.request_preempt(), oneshot=True)
print(run(long, ENDS)[0])
timed = Action(
    "work", LookupTransformAction, goal=LookupTransformGoal(target_frame="long"), exec_timeout=rospy.Duration(0.3)
)
print(run(timed, ENDS)[0])
print(run(Action("nobody", LookupTransformAction, server_wait_timeout=rospy.Duration(0.5)), ENDS)[0])
outcome, data = run(
    smach_ros.ServiceState("frames", FrameGraph, response_slots=["frame_yaml"], response_key="all"), ENDS
)
print(outcome, data.frame_yaml, data["all"].frame_yaml)
print(
    run(
        smach_ros.ServiceState("frames", FrameGraph, response_cb=lambda ud, response: "own", outcomes=["own"]),
        [*ENDS, "own"],
    )[0]
)
monitor = smach_ros.MonitorState("numbers", Int32, lambda ud, msg: msg.data != 7, max_checks=1)
print(run(monitor, ["valid", "invalid", "preempted"])[0])
print(
    run(
        smach_ros.MonitorState("numbers", Int32, lambda ud, msg: msg.data == 7, max_checks=1),
        ["valid", "invalid", "preempted"],
    )[0]
)
CONDITION = ["true", "false", "preempted"]
checks = []
print(
    run(smach_ros.ConditionState(lambda ud: checks.append(1) or len(checks) > 3, max_checks=10), CONDITION)[0],
    len(checks),
)
print(run(smach_ros.ConditionState(lambda ud: False, poll_rate=rospy.Duration(0.01), max_checks=2), CONDITION)[0])

inner = smach.StateMachine(["done", "lost"], input_keys=["goal", "result"], output_keys=["result"])


def reach(userdata):
    """Fill the result."""
    userdata.result.transform.child_frame_id = f"reached {userdata.goal.target_frame}"
    return "done" if userdata.goal.target_frame else "lost"


with inner:
    smach.StateMachine.add(
        "REACH", smach.CBState(reach, outcomes=["done", "lost"], input_keys=["goal", "result"], output_keys=["result"])
    )
wrapper = smach_ros.ActionServerWrapper(
    "wrapped", LookupTransformAction, inner, ["done"], ["lost"], goal_key="goal", result_key="result"
)
wrapper.run_server()
client = actionlib.SimpleActionClient("wrapped", LookupTransformAction)
client.wait_for_server()
for name in ("there", ""):
    state = client.send_goal_and_wait(LookupTransformGoal(target_frame=name))
    print(GoalStatus.to_string(state), client.get_result().transform.child_frame_id)

outer = smach.StateMachine(["done", "lost"])
outer.userdata.secret = 42
with outer:
    smach.StateMachine.add("INNER", inner)
    smach.StateMachine.add("LAST", smach.CBState(lambda ud: "done", outcomes=["done"]))
structures, statuses = {}, {}
a = rospy.Subscriber(
    "/view/smach/container_structure", SmachContainerStructure, lambda m: structures.update({m.path: m})
)
b = rospy.Subscriber("/view/smach/container_status", SmachContainerStatus, lambda m: statuses.update({m.path: m}))
view = smach_ros.IntrospectionServer("view", outer, "/ROOT")
view.start()
while len(structures) < 2 or len(statuses) < 2:
    rospy.sleep(0.05)
for path in sorted(structures):
    m = structures[path]
    print(
        path,
        sorted(m.children),
        sorted(zip(m.internal_outcomes, m.outcomes_from, m.outcomes_to, strict=True)),
        sorted(m.container_outcomes),
    )
    print(statuses[path].initial_states, statuses[path].active_states)
introspection = smach_ros.IntrospectionClient()
wanted = smach.UserData()
wanted.secret = 7
print(introspection.set_initial_state("view", "/ROOT", ["LAST"], wanted, rospy.Duration(30)))
print(outer.get_initial_states(), outer.userdata.secret, introspection.get_servers())
print(introspection.set_initial_state("view", "/ROOT", ["NOPE"], smach.UserData(), rospy.Duration(0.7)))
view.stop()
rospy.signal_shutdown("done")
