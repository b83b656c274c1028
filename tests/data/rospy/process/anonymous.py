import re

import rospy

rospy.init_node("someone", anonymous=True)
print(re.sub(r"\d+", "N", rospy.get_name()), rospy.get_node_uri().startswith("http://"))
