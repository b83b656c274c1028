import numpy
import rospy
from rospy.numpy_msg import numpy_msg
from sensor_msgs.msg import Image, LaserScan
from std_msgs.msg import Float32MultiArray
from wait import until

rospy.init_node("tester")
for cls, name, values in (
    (LaserScan, "ranges", numpy.array([1, 2.5], dtype=numpy.float32)),
    (Float32MultiArray, "data", numpy.arange(4, dtype=numpy.float32)),
    (Image, "data", b"\x01\x02"),
):
    received = []
    publisher = rospy.Publisher(f"numpy_{name}_{cls.__name__}", numpy_msg(cls), queue_size=1)
    subscriber = rospy.Subscriber(f"numpy_{name}_{cls.__name__}", numpy_msg(cls), received.append)
    until(lambda: publisher.get_num_connections() == 1)
    message = cls()
    setattr(message, name, values)
    publisher.publish(message)
    until(lambda: received)
    value = getattr(received[0], name)
    print(
        cls.__name__,
        type(value).__name__,
        getattr(value, "dtype", None),
        list(value) if isinstance(value, bytes) else value.tolist(),
        received[0]._type,
    )
