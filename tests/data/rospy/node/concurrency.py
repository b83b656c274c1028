import threading

import rospy
from std_msgs.msg import Int32
from wait import until

rospy.init_node("tester")
gate, received, names = threading.Event(), [], set()


def slow(message):
    gate.wait(60)
    received.append("slow")


def quick(message):
    names.add(threading.current_thread() is threading.main_thread())
    received.append("quick")


one, two = rospy.Publisher("slow", Int32, queue_size=10), rospy.Publisher("quick", Int32, queue_size=10)
subscribers = rospy.Subscriber("slow", Int32, slow), rospy.Subscriber("quick", Int32, quick)
until(lambda: one.get_num_connections() == 1 and two.get_num_connections() == 1)
one.publish(1)
two.publish(1)
until(lambda: received)
gate.set()
until(lambda: len(received) == 2)
print(received, names)
