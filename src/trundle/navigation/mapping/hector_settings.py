"""hector_mapping's parameters, with the original's names and defaults."""

from typing import Annotated

from msgspec import Meta, Struct

from trundle.base.built import refuse_stale

from . import _mapping

refuse_stale(_mapping)
_MAX_SIZE = 20_000
_Probability = Annotated[float, Meta(ge=0.01, le=0.99)]
_Ratio = Annotated[float, Meta(ge=0.0, le=1.0)]
_Length = Annotated[float, Meta(ge=0.0, le=1e6)]


class HectorSettings(Struct):
    """Lengths [m], angles [rad], times [s]."""

    base_frame: str = "base_link"
    map_frame: str = "map"
    odom_frame: str = "odom"
    scan_topic: str = "scan"
    sys_msg_topic: str = "syscommand"
    pose_update_topic: str = "poseupdate"
    tf_map_scanmatch_transform_frame_name: str = "scanmatcher_frame"
    pub_map_odom_transform: bool = True
    pub_map_scanmatch_transform: bool = True
    pub_odometry: bool = False
    advertise_map_service: bool = True
    use_tf_scan_transformation: bool = True
    use_tf_pose_start_estimate: bool = False
    map_with_known_poses: bool = False
    scan_subscriber_queue_size: Annotated[int, Meta(ge=1, le=1000)] = 5
    map_resolution: Annotated[float, Meta(ge=0.001, le=100.0)] = 0.025
    map_size: Annotated[int, Meta(ge=2, le=_MAX_SIZE)] = 1024
    map_start_x: _Ratio = 0.5
    map_start_y: _Ratio = 0.5
    map_multi_res_levels: Annotated[int, Meta(ge=1, le=10)] = 3
    update_factor_free: _Probability = 0.4
    update_factor_occupied: _Probability = 0.9
    map_update_distance_thresh: _Length = 0.4
    map_update_angle_thresh: _Length = 0.9
    map_pub_period: Annotated[float, Meta(ge=0.01, le=1e6)] = 2.0
    laser_min_dist: _Length = 0.4
    laser_max_dist: _Length = 30.0
    laser_z_min_value: float = -1.0
    laser_z_max_value: float = 1.0

    def slam_options(self) -> _mapping.HectorOptions:
        """Return the options of the map."""
        options = _mapping.HectorOptions()
        options.resolution, options.size, options.levels = self.map_resolution, self.map_size, self.map_multi_res_levels
        options.start_x, options.start_y = self.map_start_x, self.map_start_y
        options.update_factor_free = self.update_factor_free
        options.update_factor_occupied = self.update_factor_occupied
        options.update_distance = self.map_update_distance_thresh
        options.update_angle = self.map_update_angle_thresh
        return options
