"""Parameters with bytes are xmlrpc.client.Binary."""

from xmlrpc.client import Binary

import rosgraph
import rosparam
import rospy
from wait import said

rospy.init_node("tester")
rospy.set_param("/blob", Binary(b"abc"))
rospy.set_param("/tree", {"blob": Binary(b"x"), "list": [Binary(b"y"), 2]})
value = rospy.get_param("/blob")
print(type(value).__name__, value.data, str(value), value == b"abc", rospy.get_param_cached("/blob") == value)
tree = rospy.get_param("/tree")
print(tree["blob"].data, tree["list"][0].data, rosgraph.Master("/tester").getParam("/blob").data)
rosparam.set_param("/yaml", "!!binary YWJj")
print(rospy.get_param("/yaml").data, rosparam.get_param("/yaml").data)
print(said(rospy.get_param, "/none").split(":")[0])
for name in ("/blob", "/tree", "/yaml"):
    rospy.delete_param(name)
