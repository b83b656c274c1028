"""Publisher of nav_msgs/Odometry and its frame on /tf."""

import math
from typing import Self

from trundle.robots.parameters import TagParameters
from trundle.ros import Transform, TransformBroadcaster
from trundle.sim.simulation import ModelHandle
from trundle.spatial import Pose, Twist

from .plugin_names import PluginNames

LARGE_VARIANCE = 1e12
"""Variance of the axes that planar odometry does not measure."""


class OdometryTopic:
    """Publishes a robot's pose in the odometry frame, and its twist in its own axes."""

    def __init__(
        self,
        names: PluginNames,
        topic: str,
        *,
        frame: str,
        base: str,
        variances: tuple[float, ...],
        with_tf: bool,
        twist_variances: tuple[float, ...] | None = None,
    ) -> None:
        """Advertise.

        Args:
            names: plugin's names.
            topic: topic in the plugin's namespace.
            frame: odometry frame, without its prefix.
            base: robot's frame, without its prefix.
            variances: variances of x, y, z [m²], roll, pitch, yaw [rad²].
            with_tf: True: also send the frame on /tf.
            twist_variances: variances of the velocities; None: the same values.
        """
        self._frame, self._base = names.frame(frame), names.frame(base)
        self._covariance = _diagonal(variances)
        self._twist_covariance = _diagonal(twist_variances or variances)
        self._topic = names.advertise("nav_msgs/Odometry", topic)
        self._broadcaster = TransformBroadcaster(names.node) if with_tf else None

    @classmethod
    def from_tag(
        cls,
        parameters: TagParameters,
        names: PluginNames,
        *,
        variances: tuple[float, ...],
        with_tf: bool,
        base: str = "base_footprint",
        twist_variances: tuple[float, ...] | None = None,
    ) -> Self:
        """Read <odometryTopic>, <odometryFrame> and <robotBaseFrame>, the parameters of every gazebo_ros drive.

        Warn if another model sends the same frames.
        """
        odometry = cls(
            names,
            parameters.text("odometryTopic", "odom"),
            frame=parameters.text("odometryFrame", "odom"),
            base=parameters.text("robotBaseFrame", base),
            variances=variances,
            with_tf=with_tf,
            twist_variances=twist_variances,
        )
        frames = (odometry._frame, odometry._base)
        for model, other_parameters, other_names in names.drives_before():
            other_frames = (
                other_parameters.text("odometryFrame", "odom"),
                other_parameters.text("robotBaseFrame", base),
            )
            if with_tf and frames == tuple(map(other_names.frame, other_frames)):
                problem = f"this model and {model!r} both send {' -> '.join(frames)}"
                parameters.warn(f"{problem}; a parameter tf_prefix in each namespace separates them")
                break
        return odometry

    def publish(self, time_ns: int, pose: Pose, twist: Twist, *, yaw_variance: float | None = None) -> None:
        """Publish; `twist` is in the robot's axes; `yaw_variance` replaces the variance of yaw and its rate."""
        (x, y, z), (qw, qx, qy, qz) = pose.position, pose.quaternion
        if self._broadcaster is not None:
            self._broadcaster.send_transform(
                Transform(
                    parent=self._frame,
                    child=self._base,
                    stamp_ns=time_ns,
                    translation=pose.position,
                    rotation=pose.quaternion,
                )
            )
        if not self._topic.has_subscribers:
            return
        position_and_orientation = {
            "position": {"x": x, "y": y, "z": z},
            "orientation": {"x": qx, "y": qy, "z": qz, "w": qw},
        }
        speeds = {
            "linear": dict(zip("xyz", twist.linear, strict=True)),
            "angular": dict(zip("xyz", twist.angular, strict=True)),
        }
        covariance, twist_covariance = self._covariance, self._twist_covariance
        if yaw_variance is not None:
            covariance, twist_covariance = [*covariance[:-1], yaw_variance], [*twist_covariance[:-1], yaw_variance]
        self._topic.publish(
            {
                "header": {"stamp": time_ns, "frame_id": self._frame},
                "child_frame_id": self._base,
                "pose": {"pose": position_and_orientation, "covariance": covariance},
                "twist": {"twist": speeds, "covariance": twist_covariance},
            }
        )


def _diagonal(variances: tuple[float, ...]) -> list[float]:
    return [variances[row] if row == column else 0.0 for row in range(6) for column in range(6)]


def ground_truth(model: ModelHandle) -> tuple[Pose, Twist]:
    """Return a model's pose in the world, and its twist: linear along its heading, angular in world axes."""
    pose, twist = model.pose, model.base.twist
    yaw = pose.rpy[2]
    (vx, vy, vz), cos, sin = twist.linear, math.cos(yaw), math.sin(yaw)
    return pose, Twist((cos * vx + sin * vy, cos * vy - sin * vx, vz), twist.angular)
