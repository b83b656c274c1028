import rospy
from geometry_msgs.msg import Point, Twist
from std_msgs.msg import Empty, Int32, String
from wait import said, until

rospy.init_node("tester")
strings = rospy.Publisher("wrong", String, queue_size=1)
subscriber = rospy.Subscriber("wrong", String, lambda message: None)
until(lambda: strings.get_num_connections() == 1)
print(said(strings.publish, 5))
print(said(strings.publish, Int32(5)))
print(said(strings.publish, "a", "b"))
print(said(strings.publish, "a", data="b"))
print(said(strings.publish, nope=1))
print(said(strings.publish), said(strings.publish, None))
empty = rospy.Publisher("wrong_empty", Empty, queue_size=1)
print(said(empty.publish), said(empty.publish, Empty()), said(empty.publish, String()))
twists = rospy.Publisher("wrong_twist", Twist, queue_size=1)
print(said(twists.publish, Point()), said(twists.publish, Twist()))
strings.unregister()
print(said(strings.publish, "a"))
