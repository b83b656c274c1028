from rospy.numpy_msg import numpy_msg
from sensor_msgs.msg import Image, LaserScan

print(numpy_msg(LaserScan) is numpy_msg(LaserScan), numpy_msg(Image) is numpy_msg(LaserScan))
print(isinstance(numpy_msg(LaserScan)(), numpy_msg(LaserScan)), isinstance(LaserScan(), numpy_msg(LaserScan)))
