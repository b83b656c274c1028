import rostopic
from geometry_msgs.msg import PoseArray, Pose, Twist
from sensor_msgs.msg import LaserScan

twist = Twist()
twist.linear.x = 5
poses = PoseArray(poses=[Pose(), Pose()])
poses.poses[1].position.y = 3
print(rostopic.msgevalgen("/linear/x")(twist), rostopic.msgevalgen("/linear")(twist).x, rostopic.msgevalgen(""))
print(
    rostopic.msgevalgen("/ranges[1]")(LaserScan(ranges=[1, 2, 3])),
    rostopic.msgevalgen("/ranges[1:]")(LaserScan(ranges=(1, 2, 3))),
)
print(rostopic.msgevalgen("/poses[1]/position/y")(poses), rostopic.msgevalgen("/nope")(twist))
print(rostopic.msgevalgen("/ranges[a]"), rostopic.msgevalgen("/poses[9]")(poses))

from genpy.message import strify_message
from sensor_msgs.msg import JointState

state = JointState(name=["a", "b"], position=[1.5, 2.5])
state.header.frame_id = "base"
for without_strings in (False, True):
    for without_arrays in (False, True):
        shown = rostopic.create_field_filter(without_strings, without_arrays)
        print(without_strings, without_arrays, list(shown(state)), list(shown(state.header)))
        print(strify_message(state, field_filter=shown))
