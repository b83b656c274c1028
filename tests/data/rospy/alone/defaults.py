from nav_msgs.msg import OccupancyGrid, Odometry
from sensor_msgs.msg import CameraInfo, Image, Imu, JointState, Joy, LaserScan, NavSatFix, PointCloud2
from trajectory_msgs.msg import JointTrajectoryPoint
from visualization_msgs.msg import Marker

for cls in (
    CameraInfo, Image, Imu, JointState, JointTrajectoryPoint, Joy, LaserScan, Marker, NavSatFix, OccupancyGrid,
    Odometry, PointCloud2,
):  # fmt: skip
    message = cls()
    for name in cls.__slots__:
        value = getattr(message, name)
        plain = value if isinstance(value, (int, float, str, bytes, list, tuple)) else type(value).__name__
        print(cls.__name__, name, type(value).__name__, plain)
