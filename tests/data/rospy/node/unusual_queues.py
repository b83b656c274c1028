"""Publishers' queue sizes that are no positive integers: all messages arrive."""

import rospy
from std_msgs.msg import Int32
from wait import until

rospy.init_node("tester")
for number, size in enumerate((-1, 0, True, 5.5)):
    received = []
    topic = f"/unusual_queues_{number}"
    publisher = rospy.Publisher(topic, Int32, queue_size=size)
    subscriber = rospy.Subscriber(topic, Int32, received.append)
    until(lambda: publisher.get_num_connections())
    for value in range(3):
        publisher.publish(value)
        until(lambda: len(received) > value)
    print(size, [message.data for message in received])
    publisher.unregister()
    subscriber.unregister()
