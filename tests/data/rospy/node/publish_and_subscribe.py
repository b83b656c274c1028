import rospy
from std_msgs.msg import String
from wait import until

rospy.init_node("tester")
received = []
publisher = rospy.Publisher("basic", String, queue_size=10)
subscriber = rospy.Subscriber("basic", String, received.append)
until(lambda: publisher.get_num_connections() == 1 and subscriber.get_num_connections() == 1)
for number in range(5):
    publisher.publish(f"text {number}")
publisher.publish(String("message"))
publisher.publish(data="named")
until(lambda: len(received) == 7)
print([message.data for message in received], type(received[0]).__name__)
print(publisher.resolved_name, subscriber.resolved_name, publisher.type, publisher.reg_type, subscriber.reg_type)
subscriber.unregister()
until(lambda: publisher.get_num_connections() == 0)
print(publisher.get_num_connections(), subscriber.resolved_name, subscriber.impl)
publisher.unregister()
