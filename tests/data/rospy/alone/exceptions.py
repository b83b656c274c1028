import rosgraph
import rospy

for name in sorted(dir(rospy)):
    value = getattr(rospy, name)
    if isinstance(value, type) and issubclass(value, BaseException):
        print(name, [base.__name__ for base in value.__mro__], value.__module__)
error = rospy.ROSTimeMovedBackwardsException(2.5)
print(error, error.time)
for name in ("MasterException", "MasterError", "MasterFailure"):
    print(name, [base.__name__ for base in getattr(rosgraph, name).__mro__])
print(rospy.DEBUG, rospy.INFO, rospy.WARN, rospy.ERROR, rospy.FATAL)
