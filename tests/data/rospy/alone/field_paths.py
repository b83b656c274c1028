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
