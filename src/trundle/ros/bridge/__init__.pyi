from .camera_info import camera_info_message as camera_info_message
from .camera_topics import CameraTopics as CameraTopics, make_camera_topics as make_camera_topics
from .clock import ClockTopic as ClockTopic, clock_rate_hz as clock_rate_hz
from .frame_names import (
    WORLD_FRAME as WORLD_FRAME,
    FrameNames as FrameNames,
    link_frames as link_frames,
    sensor_topic as sensor_topic,
)
from .image_messages import (
    compressed_image as compressed_image,
    depth_image as depth_image,
    image_encoder as image_encoder,
    is_compressible as is_compressible,
    point_cloud_encoder as point_cloud_encoder,
)
from .instrument_topics import make_sensor_topics as make_sensor_topics
from .joint_states import JointStatesTopic as JointStatesTopic
from .link_transforms import LinkTransforms as LinkTransforms
from .sensor_messages import (
    contacts_message as contacts_message,
    fix_message as fix_message,
    imu_message as imu_message,
    points_message as points_message,
    scan_message as scan_message,
    wrench_message as wrench_message,
)
from .sensor_topics import SENSOR_TOPICS as SENSOR_TOPICS
from .step_publisher import StepPublisher as StepPublisher
