import rospy
from geometry_msgs.msg import Point, PoseArray, Pose
from wait import until

rospy.init_node("tester")
received = []
publisher = rospy.Publisher("changed", PoseArray, queue_size=100)
subscriber = rospy.Subscriber("changed", PoseArray, received.append)
until(lambda: publisher.get_num_connections() == 1)
message = PoseArray(poses=[Pose()])
for number in range(50):
    message.poses[0].position = Point(x=number)
    publisher.publish(message)
    message.poses[0].position.x = -1
until(lambda: len(received) == 50)
print([int(each.poses[0].position.x) for each in received])
received[0].poses.append(Pose())
received[0].header.frame_id = "mine"
print(
    len(received[0].poses), received[1].header.frame_id, [each.header.seq for each in received[:3]], message.header.seq
)
