import subprocess
import sys

import rospy
from wait import until

rospy.init_node("same_name")
rospy.on_shutdown(lambda: print("hook"))
other = subprocess.Popen(
    [sys.executable, "-c", "import rospy; rospy.init_node('same_name'); print('other'); rospy.sleep(1)"],
    stdout=subprocess.PIPE,
    text=True,
)
until(rospy.is_shutdown)
print(rospy.is_shutdown())
print(other.communicate()[0])
