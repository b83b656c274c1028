"""fake_localization: publishes the true pose as if it had been estimated."""

from typing import TYPE_CHECKING

from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.private_parameters import private_parameters
from trundle.ros import Node, Transform, TransformBroadcaster, TransformError, to_nsec
from trundle.spatial import NS_PER_S, Pose

from ..pose_messages import pose_fields, read_pose
from ..transform_filter import TransformFilter

if TYPE_CHECKING:
    from trundle.ros.message_types import geometry_msgs, nav_msgs

_QUEUE = 100


class FakeLocalization:
    """Publishes `amcl_pose`, `particlecloud` and the transform of the odometry frame from `base_pose_ground_truth`.

    Parameters, with the original's defaults: odom_frame_id odom, base_frame_id base_link, global_frame_id map,
    delta_x, delta_y, delta_yaw 0 (origin of the map's frame in the simulator's), transform_tolerance 0.1. A pose on
    `initialpose` moves the map's frame so that the robot is there.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node

    async def run(self) -> int:
        """Publish until cancelled."""
        node = self._node
        settings = await private_parameters(node)
        self._odom = settings.text("odom_frame_id", "odom").lstrip("/")
        self._base = settings.text("base_frame_id", "base_link").lstrip("/")
        self._map = settings.text("global_frame_id", "map").lstrip("/")
        self._tolerance_ns = round(settings.number("transform_tolerance", 0.1) * NS_PER_S)
        x, y, yaw = (settings.number(f"delta_{axis}", 0.0) for axis in ("x", "y", "yaw"))
        self._map_from_world = Pose.from_rpy(-x, -y, 0.0, yaw=-yaw)
        self._base_in_map: Pose | None = None
        self._poses = node.advertise("amcl_pose", "geometry_msgs/PoseWithCovarianceStamped", latch=True, queue_size=1)
        self._clouds = node.advertise("particlecloud", "geometry_msgs/PoseArray", latch=True, queue_size=1)
        self._broadcaster = TransformBroadcaster(node)
        self._filter = TransformFilter(node, self._base, self._publish, queue_size=_QUEUE)
        # The true pose is in the simulator's frame; the odometry is looked up at its stamp.
        node.subscribe(
            "base_pose_ground_truth",
            "nav_msgs/Odometry",
            lambda message: self._filter.add(message, self._odom),
            queue_size=_QUEUE,
        )
        node.subscribe("initialpose", "geometry_msgs/PoseWithCovarianceStamped", self._on_initial_pose, queue_size=1)
        await node.closed.wait()
        return 0

    def _publish(self, truth: "nav_msgs.Odometry") -> None:
        stamp_ns = to_nsec(truth.header.stamp)
        try:
            odom_from_base = self._filter.buffer.lookup_transform(self._odom, self._base, stamp_ns).pose
            world_from_base = read_pose(truth.pose.pose)
        except (TransformError, ValueError) as error:
            self._node.log.error(f"a true pose is ignored: {error}")
            return
        map_from_base = self._base_in_map = self._map_from_world @ world_from_base
        map_from_odom = map_from_base @ odom_from_base.inverse()
        self._broadcaster.send_transform(
            Transform(
                parent=self._map,
                child=self._odom,
                stamp_ns=stamp_ns + self._tolerance_ns,
                translation=map_from_odom.position,
                rotation=map_from_odom.quaternion,
            )
        )
        header, pose = {"stamp": stamp_ns, "frame_id": self._map}, pose_fields(map_from_base)
        self._poses.publish({"header": header, "pose": {"pose": pose}})
        self._clouds.publish({"header": header, "poses": [pose]})

    def _on_initial_pose(self, message: "geometry_msgs.PoseWithCovarianceStamped") -> None:
        """Move the map's frame so that the robot's latest true pose is the given one."""
        frame = message.header.frame_id.lstrip("/")
        if frame != self._map:
            self._node.log.warn(f"the frame of initialpose is {frame!r}; its pose is read in {self._map!r}")
        if self._base_in_map is None:
            self._node.log.warn("initialpose is ignored: no true pose was received yet")
            return
        try:
            new_map_from_base = read_pose(message.pose.pose)
        except ValueError as error:
            self._node.log.warn(f"initialpose is ignored: {error}")
            return
        self._map_from_world = new_map_from_base @ self._base_in_map.inverse() @ self._map_from_world
        self._base_in_map = new_map_from_base
