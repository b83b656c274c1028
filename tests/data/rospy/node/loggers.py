import rospy
from roscpp.srv import GetLoggers, SetLoggerLevel
from wait import said

rospy.init_node("tester")
get, set_level = rospy.ServiceProxy("~get_loggers", GetLoggers), rospy.ServiceProxy("~set_logger_level", SetLoggerLevel)
print([(each.name, each.level) for each in get().loggers if each.name == "rosout"])
print(said(set_level, "rosout", "debug"), [each.level for each in get().loggers if each.name == "rosout"])
print(said(set_level, "rosout", "nonsense"), said(set_level, "rosout", "Info"))
print([each.level for each in get().loggers if each.name == "rosout"])
