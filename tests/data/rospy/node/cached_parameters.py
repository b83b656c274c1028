import rospy
from wait import said, until

rospy.init_node("tester")
rospy.set_param("cached/a", 1)
print(
    rospy.get_param_cached("cached/a"), rospy.get_param_cached("cached/a"), said(rospy.get_param_cached, "cached/none")
)
print(rospy.get_param_cached("cached/none", 7))
rospy.set_param("cached/a", 2)
until(lambda: rospy.get_param_cached("cached/a") == 2)
print(rospy.get_param_cached("cached/a"), rospy.get_param("cached/a"))
rospy.get_master().target.setParam("/other", "/cached/a", 3)
until(lambda: rospy.get_param_cached("cached/a") == 3)
print(rospy.get_param_cached("cached/a"))
rospy.get_master().target.setParam("/other", "/cached/none", 4)
until(lambda: rospy.get_param_cached("cached/none", 7) == 4)
print(rospy.get_param_cached("cached/none"))
rospy.delete_param("cached")
