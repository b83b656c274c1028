import copy
import pickle

from geometry_msgs.msg import PoseStamped, Twist
from sensor_msgs.msg import LaserScan
from std_srvs.srv import SetBoolRequest, SetBoolResponse

pose = PoseStamped()
pose.header.frame_id, pose.pose.position.x = "map", 3.0
for value in (pose, Twist(), LaserScan(ranges=[1.0, 2.0]), SetBoolRequest(True), SetBoolResponse(True, "ok")):
    back = pickle.loads(pickle.dumps(value))
    deep = copy.deepcopy(value)
    print(type(back).__name__, back == value, deep == value, deep is value, copy.copy(value) == value)
deep = copy.deepcopy(pose)
deep.pose.position.x = 4.0
print(pose.pose.position.x, deep.pose.position.x)
