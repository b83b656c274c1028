import rospy
from std_msgs.msg import String
from wait import until

rospy.init_node("tester")
events, received = [], []


class Listener(rospy.SubscribeListener):
    def peer_subscribe(self, topic_name, topic_publish, peer_publish):
        events.append(("come", topic_name))
        peer_publish(String("welcome"))

    def peer_unsubscribe(self, topic_name, num_peers):
        events.append(("gone", topic_name, num_peers))


publisher = rospy.Publisher("listened", String, Listener(), queue_size=1)
subscriber = rospy.Subscriber("listened", String, received.append)
until(lambda: events and received)
print(events, received[0].data)
subscriber.unregister()
until(lambda: publisher.get_num_connections() == 0)
