"""tf2_geometry_msgs, tf2_sensor_msgs, tf_conversions: stamped messages through Buffer.transform."""

import math

import numpy as np
from geometry_msgs.msg import (
    PointStamped,
    Pose,
    PoseStamped,
    Quaternion,
    TransformStamped,
    TwistStamped,
    Vector3Stamped,
    WrenchStamped,
)
from std_msgs.msg import Header

import PyKDL
import rospy
import tf2_geometry_msgs
import tf2_ros
import tf2_sensor_msgs
import tf_conversions
from sensor_msgs import point_cloud2
from tf_conversions import posemath, transformations


def r(*values):
    """Rounded."""
    return [round(float(v), 6) + 0.0 for v in values]


buffer = tf2_ros.Buffer(debug=False)
t = TransformStamped(child_frame_id="base")
t.header.frame_id, t.header.stamp = "map", rospy.Time(5)
t.transform.translation.x, t.transform.translation.y = 1, 2
t.transform.rotation = Quaternion(0, 0, math.sin(0.3), math.cos(0.3))
buffer.set_transform(t, "me")
header = Header(frame_id="base", stamp=rospy.Time(5))
point = PointStamped(header=header)
point.point.x, point.point.z = 1, 3
out = buffer.transform(point, "map")
print(type(out).__name__, out.header.frame_id, out.header.stamp.to_sec(), r(out.point.x, out.point.y, out.point.z))
vector = Vector3Stamped(header=header)
vector.vector.y = 1
v = buffer.transform(vector, "map").vector
print(r(v.x, v.y, v.z))
pose = PoseStamped(header=header)
pose.pose.position.y, pose.pose.orientation.x, pose.pose.orientation.w = 1, math.sin(0.2), math.cos(0.2)
p = buffer.transform(pose, "map", new_type=PoseStamped).pose
print(r(p.position.x, p.position.y, p.orientation.x, p.orientation.y, p.orientation.z, p.orientation.w))
wrench = WrenchStamped(header=header)
wrench.wrench.force.x, wrench.wrench.torque.z = 1, 2
w = buffer.transform(wrench, "map").wrench
print(r(w.force.x, w.force.y, w.torque.z))
print(type(buffer.transform_full(point, "map", rospy.Time(5), "map")).__name__)
cloud = buffer.transform(point_cloud2.create_cloud_xyz32(header, [(1, 0, 0), (0, 1, 0)]), "map")
print(cloud.header.frame_id, [r(*x) for x in point_cloud2.read_points(cloud)])
try:
    buffer.transform(TwistStamped(header=header), "map")
except tf2_ros.TypeException as error:
    print(error)
print(tf2_ros.convert(point, PointStamped) == point, tf2_ros.convert(point, PointStamped) is point)
try:
    tf2_ros.convert(point, str)
except tf2_ros.TypeException:
    print("no conversion")
tf2_ros.ConvertRegistration().add_from_msg(str, lambda m: f"x={m.point.x}")
print(tf2_ros.convert(point, str), tf2_ros.Stamped(Pose(), rospy.Time(3), "f").header.frame_id if False else "")
print(tf2_geometry_msgs.do_transform_point(point, t).point.x, tf2_sensor_msgs.do_transform_cloud.__name__)
frame = PyKDL.Frame(PyKDL.Rotation.RPY(0.1, 0.2, 0.3), PyKDL.Vector(1, 2, 3))
m = posemath.toMsg(frame)
print(r(m.position.x, m.position.z, m.orientation.x, m.orientation.w), posemath.fromMsg(m) == frame)
tf = posemath.toTf(frame)
print(r(*tf[0]), r(*tf[1]), tf_conversions.fromTf(tf) == frame)
print([r(*row) for row in posemath.toMatrix(frame)], posemath.fromMatrix(posemath.toMatrix(frame)) == frame)
print(np.allclose(posemath.toMatrix(frame)[:3, 3], [1, 2, 3]))
print(r(*transformations.quaternion_from_euler(0, 0, 1)))
