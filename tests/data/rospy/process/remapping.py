# arguments: chatter:=/elsewhere/talk /abs:=rel ~p:=~q __ns:=robot __name:=renamed _rate:=5 _text:=a,b _list:=[1,x] word
import sys

import rospy
from std_msgs.msg import String

before = rospy.Publisher("chatter", String, queue_size=1)
print(rospy.get_name(), rospy.get_namespace(), rospy.myargv(sys.argv[1:]))
rospy.init_node("original", anonymous=True)
print(rospy.get_name(), rospy.get_namespace(), rospy.get_caller_id(), before.resolved_name)
for name in ("chatter", "/abs", "~p", "~", "x", "/x", ""):
    print(name, rospy.resolve_name(name), rospy.remap_name(name))
print(
    rospy.get_param("~rate"), rospy.get_param("~text"), rospy.get_param("~list"), rospy.resolve_name("a", "/other/node")
)
after = rospy.Publisher("chatter", String, queue_size=1)
print(after.resolved_name, sorted(rospy.names.get_mappings().items()))
