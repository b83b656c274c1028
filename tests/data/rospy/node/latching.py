import rospy
from std_msgs.msg import Int32
from wait import until

rospy.init_node("tester")
publisher = rospy.Publisher("latched", Int32, latch=True, queue_size=1)
publisher.publish(1)
publisher.publish(2)
first, second = [], []
one = rospy.Subscriber("latched", Int32, first.append)
until(lambda: first)
two = rospy.Subscriber("latched", Int32, second.append)
until(lambda: second)
publisher.publish(3)
until(lambda: len(first) == 2 and len(second) == 2)
print([each.data for each in first], [each.data for each in second], first[0]._connection_header["latching"])
one.unregister()
third = []
three = rospy.Subscriber("latched", Int32, third.append)
until(lambda: third)
print([each.data for each in third])
