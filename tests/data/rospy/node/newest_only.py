import threading

import rospy
from std_msgs.msg import Int32
from wait import until

rospy.init_node("tester")
gate, received = threading.Event(), []


def slow(message):
    received.append(message.data)
    gate.wait(60)


publisher = rospy.Publisher("newest", Int32, queue_size=100)
subscriber = rospy.Subscriber("newest", Int32, slow, queue_size=1)
until(lambda: publisher.get_num_connections() == 1)
publisher.publish(0)
until(lambda: received)
for number in range(1, 50):
    publisher.publish(number)
rospy.sleep(1.0)
gate.set()
until(lambda: received[-1] == 49)
print(received)
