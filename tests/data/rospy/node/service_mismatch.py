import rospy
from std_srvs.srv import Empty, SetBool, SetBoolRequest, Trigger
from wait import said

rospy.init_node("tester")
service = rospy.Service("mismatch", Empty, lambda request: [])
text = str(said(rospy.ServiceProxy("mismatch", Trigger)))
print(text.partition(":")[0], "md5sums do not match" in text)
print(said(rospy.ServiceProxy("mismatch", Empty), SetBoolRequest(True)))
print(said(rospy.ServiceProxy("nowhere", Empty)))
print(said(rospy.ServiceProxy("mismatch", SetBool).call, "x").partition("[")[0])
