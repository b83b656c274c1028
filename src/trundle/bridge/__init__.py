"""Where the wings meet: snapshots and readings become messages on topics, /clock and tf."""

from typing import TYPE_CHECKING

from trundle.doors import opened_on_use

if TYPE_CHECKING:
    from .beat import Beat
    from .calibration import calibration_of
    from .camera import CameraTopics, camera_topics
    from .clock import ClockTopic, clock_rate_hz
    from .frames import SimulationFrames
    from .joint_states import JointStates
    from .measuring import ImuTopic, ScanTopic, sensor_topics
    from .naming import WORLD_FRAME, FrameNames, link_frames, sensor_topic
    from .pictures import cloud_maker, depth_image, image_maker
    from .readings import contacts_message, fix_message, imu_message, points_message, scan_message, wrench_message

_HOMES = {
    "Beat": "beat",
    "CameraTopics": "camera",
    "ClockTopic": "clock",
    "FrameNames": "naming",
    "ImuTopic": "measuring",
    "JointStates": "joint_states",
    "ScanTopic": "measuring",
    "SimulationFrames": "frames",
    "WORLD_FRAME": "naming",
    "calibration_of": "calibration",
    "camera_topics": "camera",
    "clock_rate_hz": "clock",
    "cloud_maker": "pictures",
    "contacts_message": "readings",
    "depth_image": "pictures",
    "fix_message": "readings",
    "image_maker": "pictures",
    "imu_message": "readings",
    "link_frames": "naming",
    "points_message": "readings",
    "scan_message": "readings",
    "sensor_topic": "naming",
    "sensor_topics": "measuring",
    "wrench_message": "readings",
}
__getattr__ = opened_on_use(__name__, _HOMES)

__all__ = [
    "WORLD_FRAME",
    "Beat",
    "CameraTopics",
    "ClockTopic",
    "FrameNames",
    "ImuTopic",
    "JointStates",
    "ScanTopic",
    "SimulationFrames",
    "calibration_of",
    "camera_topics",
    "clock_rate_hz",
    "cloud_maker",
    "contacts_message",
    "depth_image",
    "fix_message",
    "image_maker",
    "imu_message",
    "link_frames",
    "points_message",
    "scan_message",
    "sensor_topic",
    "sensor_topics",
    "wrench_message",
]
