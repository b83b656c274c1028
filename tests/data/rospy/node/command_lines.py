"""The mains of the command lines, called as functions."""

import rosnode
import rosparam
import rospy
import rosservice
import rostopic
from std_msgs.msg import String
from wait import said

rospy.init_node("tester")
publisher = rospy.Publisher("/command_lines/words", String, queue_size=1)
print(rosparam.yamlmain(["rosparam", "set", "/command_lines/x", "[1, 2]"]))
print(rosparam.yamlmain(["rosparam", "get", "/command_lines"]))
print(rosparam.yamlmain(["rosparam", "delete", "/command_lines/x"]))
print(rostopic.rostopicmain(["rostopic", "type", "/command_lines/words"]))
print(rostopic.rostopicmain(["rostopic", "list", "/command_lines"]))
print(rosservice.rosservicemain(["rosservice", "type", "/tester/get_loggers"]))
print(said(rosnode.rosnodemain, ["rosnode", "list", "/tester"]))
print(said(rosparam.yamlmain, ["rosparam", "get", "/command_lines/none"]).split(":")[0])
