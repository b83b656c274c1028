from actionlib_msgs.msg import GoalStatus
from diagnostic_msgs.msg import DiagnosticStatus
from rosgraph_msgs.msg import Log
from sensor_msgs.msg import JoyFeedback, NavSatStatus, PointField, Range
from visualization_msgs.msg import Marker

for cls in (GoalStatus, DiagnosticStatus, Log, JoyFeedback, NavSatStatus, PointField, Range, Marker):
    print(cls.__name__, sorted((name, value) for name, value in vars(cls).items() if name.isupper()))
print(Marker().ARROW, Marker.ARROW)
