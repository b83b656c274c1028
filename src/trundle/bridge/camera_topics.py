"""Topics of cameras: images, camera_info, point clouds, detections."""

from collections.abc import Callable, Iterable
from typing import TypeAlias

from trundle.names import ros_name
from trundle.ros import Node, Publisher, StaticTransformBroadcaster, Transform
from trundle.sensors import (
    BoundingBoxCameraSensor,
    CameraReading,
    CameraSensor,
    DepthCameraSensor,
    SegmentationCameraSensor,
    ThermalCameraSensor,
)
from trundle.spatial import Pose, quaternion_from_rpy

from .camera_info import camera_info_message
from .detection_messages import boxes_2d, boxes_3d
from .frame_names import FrameNames, global_topic, sensor_topic
from .image_messages import depth_image, image_encoder, labels_image, point_cloud_encoder, thermal_image

_HALF_TURN = 1.5707963267948966
CAMERA_FROM_OPTICAL = Pose(quaternion=quaternion_from_rpy(-_HALF_TURN, 0.0, -_HALF_TURN))
"""Pose of the optical frame (z forward, x right, y down; REP 103) in SDF's camera frame (x forward, z up)."""
_Make: TypeAlias = Callable[[CameraReading], dict[str, object]]
_Output: TypeAlias = tuple[str, str, _Make]
"""Topic, type, and function from a reading to the message without its header."""


def make_camera_topics(
    node: Node, static_broadcaster: StaticTransformBroadcaster, cameras: Iterable[CameraSensor], names: FrameNames
) -> None:
    """Advertise the topics of cameras."""
    for camera in cameras:
        CameraTopics(node, static_broadcaster, camera, names)


class CameraTopics:
    """`<model>/<link>/<sensor>/image_raw`, `camera_info` and more by the camera's type; messages are made only for
    subscribers."""

    def __init__(
        self, node: Node, static_broadcaster: StaticTransformBroadcaster, camera: CameraSensor, names: FrameNames
    ) -> None:
        """Advertise, and send the optical frame.

        Args:
            node: publishes the topics.
            static_broadcaster: of the node's /tf_static.
            camera: the sensor to publish.
            names: names of frames.
        """
        model, link = camera.model, camera.link
        carrier = names.link(model, link.name)
        part = f"/{camera.optics.name}" if camera.optics.name else ""
        optical_frame = camera.optics.optical_frame
        there = names.find_link(model, optical_frame) if optical_frame else None
        self.frame = there or (
            ros_name(optical_frame)
            if optical_frame
            else names.sensor(model, link.name, camera.sensor, rest=f"{part}_optical")
        )
        optical = camera.link_from_camera @ CAMERA_FROM_OPTICAL
        if there is None:
            static_broadcaster.send_transform(
                Transform(parent=carrier, child=self.frame, translation=optical.position, rotation=optical.quaternion)
            )
        outputs = _outputs(camera)
        main = outputs[0][0]
        self._topics: list[tuple[Publisher, _Make]] = []
        for output, type_, make in outputs:
            topic = sensor_topic(model, link.name, camera.sensor, output, main=main, part=camera.optics.name)
            if output == "camera_info" and camera.optics.info_topic:
                topic = global_topic(camera.optics.info_topic)
            self._topics.append((node.advertise(topic, type_, queue_size=2), make))
        if camera.optics.triggered:
            own = sensor_topic(model, link.name, camera.sensor, "trigger", main=main, part=camera.optics.name)
            topic = global_topic(camera.optics.trigger_topic) if camera.optics.trigger_topic else own
            trigger = camera.await_trigger()
            node.subscribe(topic, "std_msgs/Bool", lambda _: trigger(), queue_size=1)
        camera.listen(self._publish, enabled=lambda: any(topic.has_subscribers for topic, _ in self._topics))

    def _publish(self, reading: CameraReading) -> None:
        header = {"stamp": reading.time_ns, "frame_id": self.frame}
        for topic, make in self._topics:
            if topic.has_subscribers:
                topic.publish({**make(reading), "header": header})


def _outputs(camera: CameraSensor) -> list[_Output]:
    """Outputs of a camera, the main one first."""
    calibration = camera_info_message(camera)
    info: _Output = ("camera_info", "sensor_msgs/CameraInfo", lambda _: calibration)
    colours: _Output = ("image_raw", "sensor_msgs/Image", image_encoder(camera.optics.format))
    match camera:
        case DepthCameraSensor():
            return [
                colours,
                info,
                ("depth/image_raw", "sensor_msgs/Image", depth_image),
                ("depth/camera_info", "sensor_msgs/CameraInfo", lambda _: calibration),
                ("points", "sensor_msgs/PointCloud2", point_cloud_encoder(camera)),
            ]
        case SegmentationCameraSensor():
            return [
                ("labels_map", "sensor_msgs/Image", labels_image),
                info,
                ("colored_map", "sensor_msgs/Image", image_encoder("R8G8B8")),
            ]
        case BoundingBoxCameraSensor() if camera.optics.box_type == "3d":
            return [("boxes", "vision_msgs/Detection3DArray", boxes_3d), info, colours]
        case BoundingBoxCameraSensor():
            return [("boxes", "vision_msgs/Detection2DArray", boxes_2d), info, colours]
        case ThermalCameraSensor():
            return [("image_raw", "sensor_msgs/Image", thermal_image), info]
        case _:
            return [colours, info]
