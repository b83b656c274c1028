"""Topics of cameras: images, camera_info, point clouds, detections."""

from collections.abc import Iterable

from trundle.robots.names import ros_name
from trundle.ros import Node, Publisher, StaticTransformBroadcaster, Transform
from trundle.sim.sensors import CameraReading, CameraSensor
from trundle.spatial import Pose, quaternion_from_rpy

from .frame_names import FrameNames, global_topic, sensor_topic
from .sensor_topics import Encode, outputs_of

_HALF_TURN = 1.5707963267948966
CAMERA_FROM_OPTICAL = Pose(quaternion=quaternion_from_rpy(-_HALF_TURN, 0.0, -_HALF_TURN))
"""Pose of the optical frame (z forward, x right, y down; REP 103) in SDF's camera frame (x forward, z up)."""


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
            node: node that publishes the topics.
            static_broadcaster: broadcaster of the node's /tf_static.
            camera: sensor to publish.
            names: frame names.
        """
        model, link = camera.model, camera.link
        parent = names.link(model, link.name)
        part = f"/{camera.optics.name}" if camera.optics.name else ""
        optical_frame = camera.optics.optical_frame
        link_frame = names.find_link(model, optical_frame) if optical_frame else None
        self.frame = link_frame or (
            ros_name(optical_frame)
            if optical_frame
            else names.sensor(model, link.name, camera.sensor, rest=f"{part}_optical")
        )
        optical = camera.link_from_camera @ CAMERA_FROM_OPTICAL
        if link_frame is None:
            static_broadcaster.send_transform(
                Transform(parent=parent, child=self.frame, translation=optical.position, rotation=optical.quaternion)
            )
        outputs = outputs_of(camera)
        main = outputs[0].name
        self._topics: list[tuple[Publisher, Encode]] = []
        for row in outputs:
            topic = sensor_topic(model, link.name, camera.sensor, row.name, main=main, part=camera.optics.name)
            if row.name == "camera_info" and camera.optics.info_topic:
                topic = global_topic(camera.optics.info_topic)
            self._topics.append((node.advertise(topic, row.type, queue_size=row.queue_size), row.encoder(camera)))
        camera.topics = {topic.topic: topic.type for topic, _ in self._topics}
        if camera.optics.triggered:
            if camera.optics.trigger_topic:
                topic = global_topic(camera.optics.trigger_topic)
            else:
                topic = sensor_topic(model, link.name, camera.sensor, "trigger", main=main, part=camera.optics.name)
            trigger = camera.await_trigger()
            node.subscribe(topic, "std_msgs/Bool", lambda _: trigger(), queue_size=1)
        camera.listen(self._publish, enabled=lambda: any(topic.has_subscribers for topic, _ in self._topics))

    def _publish(self, reading: CameraReading) -> None:
        header = {"stamp": reading.time_ns, "frame_id": self.frame}
        for topic, encode in self._topics:
            if topic.has_subscribers:
                topic.publish({**encode(reading), "header": header})
