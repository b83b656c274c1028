"""Names that the master refuses: the program goes on, and the terminal names them; what a service raises is no such."""

import io
import re
import sys

sys.stderr, err = io.StringIO(), sys.stderr
import rospy
from std_msgs.msg import String
from std_srvs.srv import Empty

rospy.init_node("illegal_names")
publisher = rospy.Publisher("with blank", String, queue_size=1)
subscriber = rospy.Subscriber("with blank too", String)
service = rospy.Service("raises", Empty, lambda request: 1 / 0)
try:
    rospy.ServiceProxy("raises", Empty)()
except rospy.ServiceException as error:
    print(error)
warned, sys.stderr = sys.stderr.getvalue(), err
print(re.sub(r"\d{6,}\.\d+", "T", "\n".join(line for line in warned.splitlines() if "FATAL" in line)))
print([topic for topic, _ in rospy.get_published_topics() if "blank" in topic])
