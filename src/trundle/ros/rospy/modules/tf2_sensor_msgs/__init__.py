"""sensor_msgs for tf2; importing it registers PointCloud2 for `Buffer.transform`."""

from .tf2_sensor_msgs import do_transform_cloud, from_msg_msg, to_msg_msg, transform_to_kdl

__all__ = ["do_transform_cloud", "from_msg_msg", "to_msg_msg", "transform_to_kdl"]
