# environment: ROSCONSOLE_FORMAT=${severity}|${node}|${logger}|${message}|${function}|${file}
import rospy

rospy.init_node("formatted")
exec(compile("def speak():\n    rospy.loginfo('text')\n", "spoken.py", "exec"))
speak()
