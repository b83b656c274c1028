"""Stand-in for turtlesim, for programs that follow its turtles: spawn and kill, poses, and the turtles' frames."""

from geometry_msgs.msg import TransformStamped
from std_srvs.srv import Empty
from turtlesim.msg import Pose
from turtlesim.srv import Kill, Spawn

import rospy
import tf2_ros

TURTLES = ("turtle1", "turtle2")
rospy.init_node("turtlesim", disable_rosout=True)
for program in ("turtle_tf_broadcaster", "turtle_tf2_broadcaster", "tf_turtle", "tf2_turtle"):
    rospy.set_param(f"/{program}/turtle", "turtle1")
rospy.set_param("/turtle", "turtle2")
poses = {name: rospy.Publisher(f"/{name}/pose", Pose, queue_size=1) for name in TURTLES}
frames = tf2_ros.TransformBroadcaster()
services = [
    rospy.Service("/spawn", Spawn, lambda request: [request.name]),
    rospy.Service("/kill", Kill, lambda _: []),
    rospy.Service("/clear", Empty, lambda _: []),
]
print("ready", flush=True)


def tick(event):
    """Publish the poses of the turtles."""
    for x, name in enumerate(TURTLES, 1):
        poses[name].publish(Pose(x=x, y=5, theta=0.5))
        frame = TransformStamped(child_frame_id=name)
        frame.header.stamp, frame.header.frame_id = rospy.Time.now(), "world"
        frame.transform.translation.x, frame.transform.rotation.w = x, 1
        frames.sendTransform(frame)


timer = rospy.Timer(rospy.Duration(0.1), tick)
rospy.spin()
