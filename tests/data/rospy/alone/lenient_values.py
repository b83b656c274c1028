import io

import numpy as np

from geometry_msgs.msg import Point
from nav_msgs.msg import OccupancyGrid
from sensor_msgs.msg import Image, JointState, LaserScan
from std_msgs.msg import Bool, Float32, Float64MultiArray, Int32, UInt8MultiArray


def written(message):
    buff = io.BytesIO()
    message.serialize(buff)
    print(type(message).__name__, buff.getvalue().hex())


written(Point(np.float64(1), np.float32(2), np.int64(3)))
written(Int32(np.int64(5)))
written(Int32(True))
written(Bool(np.bool_(True)))
written(Float32(True))
written(LaserScan(ranges=np.array([1, 2], dtype=np.float32)))
written(LaserScan(ranges=np.array([1, 2], dtype=np.float64)))
written(LaserScan(ranges=np.array([1, 2])))
written(LaserScan(ranges=[np.float32(1), 2]))
written(LaserScan(ranges=range(3)))
written(JointState(position=np.linspace(0, 1, 3), name=("a", "b")))
written(Float64MultiArray(data=np.eye(2).flatten()))
written(Image(data=np.arange(6, dtype=np.uint8).tobytes()))
written(Image(data=[1, 2, 3]))
written(Image(data=bytearray(b"abc")))
written(UInt8MultiArray(data=np.arange(3, dtype=np.uint8).tolist()))
written(OccupancyGrid(data=np.array([-1, 100], dtype=np.int8)))
written(OccupancyGrid(data=[-1, 100, 0]))
