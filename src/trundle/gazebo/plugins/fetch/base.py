"""robot_controllers/DiffDriveBaseController: the wheels, /odom and its frame."""

from dataclasses import replace

from trundle.robots.parameters import RosParameters

from ..ros_control import BaseOdometry, ControllerContext, DiffDriveController, Endpoints

_NAMES = {
    "l_wheel_joint": "left_wheel",
    "r_wheel_joint": "right_wheel",
    "track_width": "wheel_separation",
    "timeout": "cmd_vel_timeout",
    "publish_frequency": "publish_rate",
    "odometry_frame": "odom_frame_id",
    "base_frame": "base_frame_id",
    "publish_tf": "enable_odom_tf",
}
"""Parameter → that of diff_drive_controller."""
_DEFAULTS = {
    "left_wheel": "l_wheel_joint",
    "right_wheel": "r_wheel_joint",
    "wheel_separation": 0.37476,
    "cmd_vel_timeout": 0.25,
    "publish_rate": 100.0,
}


class DiffDriveBase(DiffDriveController):
    """Drives by `<name>/command` (geometry_msgs/Twist); publishes /odom and its frame.

    Parameters, with the original's defaults: l_wheel_joint, r_wheel_joint, track_width 0.37476 [m], radians_per_meter
    16.5289, timeout 0.25 [s], max_velocity_x 1, max_velocity_r 4.5, max_acceleration_x 0.75, max_acceleration_r 3,
    publish_frequency 100, odometry_frame odom, base_frame base_link, publish_tf true.
    """

    def __init__(self, context: ControllerContext) -> None:
        super().__init__(replace(context, settings=_renamed(context.settings)))

    def _advertise(self, settings: RosParameters) -> None:
        context = self._context
        self._endpoints = Endpoints()
        everywhere = replace(context, name="")  # /odom
        self._odometry = BaseOdometry(everywhere, self._endpoints, frame=settings.text("odom_frame_id", "odom"))
        self._endpoints.add(
            context.node.subscribe(f"{context.name}/command", "geometry_msgs/Twist", self._on_command, queue_size=1)
        )
        self._limited_topic = None


def _renamed(settings: RosParameters) -> RosParameters:
    """Return the parameters as those of diff_drive_controller."""

    def limits(axis: str, velocity: float, acceleration: float) -> dict[str, object]:
        return {
            "has_velocity_limits": True,
            "max_velocity": settings.number(f"max_velocity_{axis}", velocity),
            "has_acceleration_limits": True,
            "max_acceleration": settings.number(f"max_acceleration_{axis}", acceleration),
        }

    fixed = {
        "wheel_radius": 1.0 / settings.number("radians_per_meter", 16.5289, above=0.0),
        "linear": {"x": limits("x", 1.0, 0.75)},
        "angular": {"z": limits("r", 4.5, 3.0)},
    }
    return settings.renamed(_NAMES).with_defaults({**_DEFAULTS, **fixed})
