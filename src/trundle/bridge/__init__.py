"""Where the wings meet: snapshots and readings become messages on topics, /clock and tf."""

from .camera import CameraTopics, camera_topics
from .clock import ClockTopic, clock_rate_hz
from .frames import SimulationFrames
from .joint_states import JointStates
from .measuring import ImuTopic, ScanTopic, sensor_topics
from .naming import WORLD_FRAME, has_plain_frames, link_frame_name, link_frames

__all__ = [
    "WORLD_FRAME",
    "CameraTopics",
    "ClockTopic",
    "ImuTopic",
    "JointStates",
    "ScanTopic",
    "SimulationFrames",
    "camera_topics",
    "clock_rate_hz",
    "has_plain_frames",
    "link_frame_name",
    "link_frames",
    "sensor_topics",
]
