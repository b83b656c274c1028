"""robot_pose_publisher: the robot's pose in the map, from tf, for web pages."""

from trundle.ros import Node, TransformError, TransformListener

from .host import NodeHost
from .private_parameters import private_parameters
from .rate import Rate


class RobotPosePublisher:
    """Publishes `robot_pose`.

    Parameters, with the original's defaults: map_frame map, base_frame base_link, publish_frequency 10, is_stamped
    false (a geometry_msgs/Pose without header).
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node

    async def run(self) -> int:
        """Publish until cancelled."""
        node = self._node
        settings = await private_parameters(node)
        world = settings.text("map_frame", "map").lstrip("/")
        base = settings.text("base_frame", "base_link").lstrip("/")
        is_stamped = settings.flag("is_stamped", default=False)
        rate = Rate(node, settings.number("publish_frequency", 10.0, above=0.0))
        topic = node.advertise("robot_pose", f"geometry_msgs/Pose{'Stamped' if is_stamped else ''}", queue_size=1)
        buffer = TransformListener(node).buffer
        while not node.closed.is_set():
            try:
                transform = buffer.lookup_transform(world, base)
            except TransformError:
                pass  # nothing localizes the robot yet
            else:
                (x, y, z), (qw, qx, qy, qz) = transform.translation, transform.rotation
                pose = {"position": {"x": x, "y": y, "z": z}, "orientation": {"w": qw, "x": qx, "y": qy, "z": qz}}
                header = {"stamp": node.clock.now_ns(), "frame_id": world}
                topic.publish({"header": header, "pose": pose} if is_stamped else pose)
            await rate.sleep()
        return 0
