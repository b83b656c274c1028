import rospy
from std_msgs.msg import Int32
from wait import until

rospy.init_node("tester")
received = []


def callback(message):
    received.append(message.data)
    raise ValueError("within a callback")


publisher = rospy.Publisher("raising", Int32, queue_size=10)
subscriber = rospy.Subscriber("raising", Int32, callback)
until(lambda: publisher.get_num_connections() == 1)
publisher.publish(1)
publisher.publish(2)
until(lambda: len(received) == 2)
print(received)
