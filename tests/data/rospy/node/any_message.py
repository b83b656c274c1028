import rospy
from geometry_msgs.msg import Point
from wait import until

rospy.init_node("tester")
received, again = [], []
publisher = rospy.Publisher("any", Point, queue_size=10)
subscriber = rospy.Subscriber("any", rospy.AnyMsg, received.append)
until(lambda: publisher.get_num_connections() == 1)
publisher.publish(1, 2, 3)
until(lambda: received)
message = received[0]
print(
    type(message).__name__,
    message._buff.hex(),
    message._connection_header["type"],
    message._connection_header["md5sum"],
)
print(message._connection_header["topic"], message._connection_header["callerid"], Point().deserialize(message._buff))
copies = rospy.Publisher("any_copy", Point, queue_size=10)
subscriber = rospy.Subscriber("any_copy", Point, again.append)
until(lambda: copies.get_num_connections() == 1)
copies.publish(message)
until(lambda: again)
print(again)
