"""A camera's pictures and calibration on ROS topics."""

from trundle.model import World
from trundle.names import ros_name
from trundle.ros import Node, StaticTransformBroadcaster, Transform
from trundle.sensors import CameraReading, CameraSensor
from trundle.spatial import Pose, quaternion_from_rpy

from .naming import has_plain_frames, link_frame_name

_HALF_TURN = 1.5707963267948966
CAMERA_FROM_OPTICAL = Pose(quaternion=quaternion_from_rpy(-_HALF_TURN, 0.0, -_HALF_TURN))
"""SDF's cameras look along x with z up; ROS images have z forward, x right, y down (REP 103)."""


class CameraTopics:
    """`<model>/<link>/<sensor>/image_raw` and `camera_info`, drawn only while somebody subscribes."""

    def __init__(self, node: Node, still: StaticTransformBroadcaster, camera: CameraSensor, world: World) -> None:
        """Advertise, and place the optical frame.

        Args:
            node: publishes.
            still: the node's one broadcaster for /tf_static.
            camera: what to publish.
            world: names the frames.
        """
        model, link = camera.model, camera.link
        plain = has_plain_frames(world)
        carrier = link_frame_name(model, link.name, plain=plain)
        self.frame = f"{link_frame_name(model, camera.name, plain=plain)}_optical"
        optical = camera.link_from_camera @ CAMERA_FROM_OPTICAL
        still.send(
            Transform(parent=carrier, child=self.frame, translation=optical.position, rotation=optical.quaternion)
        )
        base = f"/{ros_name(model.name)}/{ros_name(link.name)}/{ros_name(camera.name)}"
        self._image = node.advertise(f"{base}/image_raw", "sensor_msgs/Image", queue_size=2)
        self._info = node.advertise(f"{base}/camera_info", "sensor_msgs/CameraInfo", queue_size=2)
        self._calibration = _calibration(camera)
        camera.listen(self._publish, wanted=lambda: self._image.has_subscribers or self._info.has_subscribers)

    def _publish(self, reading: CameraReading) -> None:
        header = {"stamp": reading.time_ns, "frame_id": self.frame}
        height, width, _ = reading.rgb.shape
        if self._image.has_subscribers:
            self._image.publish(
                {
                    "header": header,
                    "height": height,
                    "width": width,
                    "encoding": "rgb8",
                    "step": 3 * width,
                    "data": reading.rgb.reshape(-1),
                }
            )
        if self._info.has_subscribers:
            self._info.publish({**self._calibration, "header": header})


def _calibration(camera: CameraSensor) -> dict[str, object]:
    """K, D, R and P of a pinhole without distortion, with gazebo_ros's principal point (w + 1)/2, (h + 1)/2."""
    seen = camera.intrinsics
    f, cx, cy = seen.focal_px, (seen.width_px + 1) / 2, (seen.height_px + 1) / 2
    return {
        "height": seen.height_px,
        "width": seen.width_px,
        "distortion_model": "plumb_bob",
        "D": [0.0] * 5,
        "K": [f, 0.0, cx, 0.0, f, cy, 0.0, 0.0, 1.0],
        "R": [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        "P": [f, 0.0, cx, 0.0, 0.0, f, cy, 0.0, 0.0, 0.0, 1.0, 0.0],
    }
