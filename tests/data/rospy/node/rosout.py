import rospy
from rosgraph_msgs.msg import Log
from wait import until

rospy.init_node("tester")
received = []
subscriber = rospy.Subscriber(
    "/rosout", Log, lambda log: received.append(log) if log.name == "/tester" and "#" in log.msg else None
)
until(lambda: subscriber.get_num_connections() >= 1 and __import__("rosgraph").Master("/x").getSystemState())


class Speaker:
    def speak(self):
        rospy.logwarn("#in a method")


def speak():
    rospy.logerr("#in a function %s %d", "a", 3)


rospy.sleep(0.5)
rospy.logdebug("#debug is not shown")
rospy.loginfo("#info")
speak()
Speaker().speak()
rospy.logfatal("#fatal")
rospy.loginfo("#named", logger_name="sub")
until(lambda: len([each for each in received if each.msg == "#named"]))
for log in received:
    print(log.level, log.name, log.msg, log.file, log.function, log.line > 0, "/rosout" in log.topics)
