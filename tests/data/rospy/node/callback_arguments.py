import rospy
from std_msgs.msg import String
from wait import said, until

rospy.init_node("tester")
received = []
publisher = rospy.Publisher("arguments", String, queue_size=10)
one = rospy.Subscriber("arguments", String, lambda message, extra: received.append((message.data, extra)), ("a", 1))
two = rospy.Subscriber("arguments", String, lambda message, extra: received.append((message.data, extra)), "b")
zero = rospy.Subscriber(
    "arguments", String, lambda message, extra: received.append((message.data, extra)), callback_args=0
)
bad = rospy.Subscriber("arguments", String, lambda: 0)
until(lambda: publisher.get_num_connections() == 1)
publisher.publish("x")
until(lambda: len(received) == 3)
print(sorted(received, key=str), one.callback_args, publisher.get_num_connections())
print(said(rospy.Subscriber, "arguments", String, None, None, 0))
print(said(rospy.Subscriber, "arguments", String, None, None, 1.5))
print(said(rospy.Subscriber, "arguments", String, None, None, None, 0))
print(said(rospy.Subscriber, "arguments", String, None, None, None, "x"))
