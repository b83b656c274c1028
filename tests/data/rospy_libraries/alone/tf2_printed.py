"""tf2 as programs print it: a transform backwards, the names beside the classes, times that are none."""

import traceback

import rospy
import tf2_ros

buffer = tf2_ros.BufferCore()
forwards = tf2_ros.TransformStamped(child_frame_id="base")
forwards.header = tf2_ros.Header(frame_id="map", stamp=rospy.Time(3))
forwards.transform.translation.x = forwards.transform.rotation.w = 1.0
buffer.set_transform(forwards, "me")
print(buffer.lookup_transform_core("base", "map", rospy.Time(3)))
for stamp in (3, 3.5, None):
    try:
        buffer.lookup_transform_core("map", "base", stamp)
    except TypeError as error:
        print(error)
print(tf2_ros.TFMessage([forwards]) == tf2_ros.TFMessage([forwards]), tf2_ros.LookupTransformGoal().timeout)
try:
    buffer.lookup_transform_core("map", "nowhere", rospy.Time(0))
except tf2_ros.LookupException as error:
    print("".join(traceback.format_exception_only(type(error), error)))
