"""sensor_msgs for tf2: import it, and `Buffer.transform` knows PointCloud2."""

from .tf2_sensor_msgs import do_transform_cloud, from_msg_msg, to_msg_msg, transform_to_kdl

__all__ = ["do_transform_cloud", "from_msg_msg", "to_msg_msg", "transform_to_kdl"]
