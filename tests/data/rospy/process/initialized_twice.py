import warnings

import rospy
from wait import said

rospy.init_node("twice", disable_signals=True)
print(said(rospy.init_node, "twice", disable_signals=True))
print(str(said(rospy.init_node, "other")).partition(": (")[0])
with warnings.catch_warnings(record=True) as caught:
    warnings.simplefilter("always")
    rospy.set_param("bad name", 1)
    print([str(each.message) for each in caught])
rospy.delete_param("bad name")
