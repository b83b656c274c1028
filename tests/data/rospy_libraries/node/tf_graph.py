"""Broadcasters and listeners of tf and tf2 on the graph."""

from geometry_msgs.msg import TransformStamped

import rospy
import tf
import tf2_ros

rospy.init_node("tf_graph")
listener = tf.TransformListener()
buffer = tf2_ros.Buffer(rospy.Duration(30.0))
tf2_listener = tf2_ros.TransformListener(buffer)
moving, moving2, fixed = tf.TransformBroadcaster(), tf2_ros.TransformBroadcaster(), tf2_ros.StaticTransformBroadcaster()


def stamped(parent, child, x, stamp):
    """TransformStamped along x."""
    m = TransformStamped(child_frame_id=child)
    m.header.frame_id, m.header.stamp = parent, stamp
    m.transform.translation.x, m.transform.rotation.w = x, 1
    return m


fixed.sendTransform(
    [stamped("base", "laser", 0.5, rospy.Time.now()), stamped("base", "camera", 0.25, rospy.Time.now())]
)


def broadcast(_event):
    """Send now."""
    now = rospy.Time.now()
    moving.sendTransform((1, 2, 0), tf.transformations.quaternion_from_euler(0, 0, 1), now, "odom", "map")
    moving2.sendTransform([stamped("odom", "base", 3, now)])


timer = rospy.Timer(rospy.Duration(0.05), broadcast)
listener.waitForTransform("map", "laser", rospy.Time(0), rospy.Duration(30))
xyz, xyzw = listener.lookupTransform("map", "laser", rospy.Time(0))
print([round(v, 4) for v in xyz], [round(v, 4) for v in xyzw])
then = rospy.Time.now()
found = buffer.lookup_transform("map", "camera", then, rospy.Duration(30))
t = found.transform.translation
print(
    found.header.frame_id,
    found.child_frame_id,
    abs((found.header.stamp - then).to_sec()) < 1e-6,
    round(t.x, 4),
    round(t.y, 4),
)
print(bool(buffer.can_transform("laser", "camera", rospy.Time(0))))
print(bool(buffer.can_transform("laser", "nope", rospy.Time(0), rospy.Duration(0.2))))
print(buffer.can_transform("laser", "nope", rospy.Time(0), return_debug_tuple=True)[1])
full = buffer.lookup_transform_full("base", then, "camera", then, "map", rospy.Duration(30))
print(full.header.frame_id, round(full.transform.translation.x, 4))
try:
    buffer.lookup_transform("map", "nope", rospy.Time(0), rospy.Duration(0.1))
except tf2_ros.LookupException as error:
    print(error)
try:
    buffer.lookup_transform("map", "base", rospy.Time.now() + rospy.Duration(100))
except (tf2_ros.ConnectivityException, tf2_ros.ExtrapolationException) as error:
    print(type(error).__name__)
service = rospy.ServiceProxy("~tf2_frames", __import__("tf2_msgs.srv", fromlist=["FrameGraph"]).FrameGraph)
print(sorted(line for line in service().frame_yaml.splitlines() if not line.startswith(" ")))
timer.shutdown()
tf2_listener.unregister()
try:
    tf2_ros.BufferInterface().lookup_transform("a", "b", rospy.Time(0))
except tf2_ros.NotImplementedException as error:
    print(type(error).__name__)
try:
    buffer.transform(rospy.Time(0), "map")
except tf2_ros.TypeException as error:
    print(type(error).__name__)
