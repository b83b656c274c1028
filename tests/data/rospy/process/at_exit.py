import rospy

rospy.init_node("exiting")
rospy.on_shutdown(lambda: print("on exit", rospy.is_shutdown()))
print("end of the program")
