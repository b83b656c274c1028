"""tf.Transformer without a graph: lookups, chains, twists, errors, messages in another frame."""

from geometry_msgs.msg import (
    Point32,
    PointStamped,
    PoseStamped,
    QuaternionStamped,
    TransformStamped,
    Vector3Stamped,
)
from sensor_msgs.msg import PointCloud

import rospy
import tf


def put(parent, child, stamp, xyz, rpy=(0, 0, 0)):
    """Add a transform."""
    m = TransformStamped(child_frame_id=child)
    m.header.frame_id, m.header.stamp = parent, rospy.Time.from_sec(stamp)
    v, q = m.transform.translation, m.transform.rotation
    v.x, v.y, v.z = xyz
    q.x, q.y, q.z, q.w = tf.transformations.quaternion_from_euler(*rpy)
    t.setTransform(m)


def numbers(values):
    """Rounded, without minus zero."""
    return [round(float(v), 6) + 0.0 for v in values]


t = tf.TransformerROS(True, rospy.Duration(10.0))
put("world", "base", 10, (1, 2, 3), (0.1, 0.2, 0.3))
put("world", "base", 12, (3, 2, 1), (0.3, -0.2, 1.3))
put("base", "arm", 10, (0, 0, 1))
put("base", "arm", 12, (0, 1, 1), (0, 0, 1.5))
for target, source, stamp in (
    ("world", "base", 10),
    ("base", "world", 11),
    ("/world", "/arm", 11.5),
    ("arm", "world", 0),
):
    xyz, xyzw = t.lookupTransform(target, source, rospy.Time.from_sec(stamp))
    print(target, source, numbers(xyz), numbers(xyzw), type(xyz).__name__)
print([numbers(x) for x in t.lookupTransformFull("arm", rospy.Time(10), "arm", rospy.Time(12), "world")])
print(t.canTransform("world", "arm", rospy.Time(11)), t.canTransform("world", "arm", rospy.Time(13)))
print(t.canTransformFull("arm", rospy.Time(10), "arm", rospy.Time(12), "world"))
print(
    t.getLatestCommonTime("world", "arm").to_sec(),
    t.frameExists("base"),
    t.frameExists("x"),
    sorted(t.getFrameStrings()),
)
print(t.chain("arm", rospy.Time(11), "world", rospy.Time(11), "world"), repr(t.getTFPrefix()))
print(t.allFramesAsString())
for bad in (("world", "nope", 10), ("world", "base", 13)):
    try:
        t.lookupTransform(bad[0], bad[1], rospy.Time(bad[2]))
    except tf.Exception as error:
        print(type(error).__name__, error)
try:
    t.waitForTransform("world", "base", rospy.Time(10), rospy.Duration(0.1))
except tf.Exception as error:
    print(type(error).__name__)
put("other", "island", 11, (0, 0, 0))
try:
    t.lookupTransform("world", "island", rospy.Time(11))
except tf.ConnectivityException as error:
    print(type(error).__name__, error)

stamp = rospy.Time(11)
point = PointStamped()
point.header.frame_id, point.header.stamp = "arm", stamp
point.point.x, point.point.y, point.point.z = 1, 2, 3
out = t.transformPoint("world", point)
print(out.header.frame_id, out.header.stamp.to_sec(), numbers((out.point.x, out.point.y, out.point.z)))
vector = Vector3Stamped(header=point.header)
vector.vector.x, vector.vector.y = 1, 2
out = t.transformVector3("world", vector)
print(numbers((out.vector.x, out.vector.y, out.vector.z)))
pose = PoseStamped(header=point.header)
pose.pose.position.x, pose.pose.orientation.w = 1, 1
out = t.transformPose("world", pose)
p, q = out.pose.position, out.pose.orientation
print(numbers((p.x, p.y, p.z, q.x, q.y, q.z, q.w)))
turn = QuaternionStamped(header=point.header)
turn.quaternion.x = 1
q = t.transformQuaternion("world", turn).quaternion
print(numbers((q.x, q.y, q.z, q.w)))
cloud = PointCloud(header=point.header, points=[Point32(1, 2, 3), Point32(-1, 0, 0)])
print([numbers((p.x, p.y, p.z)) for p in t.transformPointCloud("world", cloud).points])
print(numbers(t.asMatrix("world", point.header).ravel()))
print(numbers(t.fromTranslationRotation((1, 2, 3), (0, 0, 0, 1)).ravel()))
t.clear()
print(t.getFrameStrings(), t.canTransform("world", "base", rospy.Time(0)))
