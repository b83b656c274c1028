import rospy
from std_msgs.msg import String
from wait import said, until

rospy.init_node("tester")
one = rospy.Publisher("shared", String, queue_size=5)
two = rospy.Publisher("shared", String, queue_size=5, latch=True)
received = []
subscriber = rospy.Subscriber("shared", String, received.append)
until(lambda: one.get_num_connections() == 1)
one.publish("a")
two.publish("b")
until(lambda: len(received) == 2)
one.unregister()
print(said(one.publish, "c"))
two.publish("d")
until(lambda: len(received) == 3)
print([each.data for each in received], two.get_num_connections())
