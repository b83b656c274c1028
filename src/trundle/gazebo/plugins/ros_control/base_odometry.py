"""Odometry of drives: `~odom`, and its frame on /tf."""

import math

from trundle.ros import Transform, TransformBroadcaster

from .controller import ControllerContext, Endpoints, PublishTimer
from .drive_settings import covariance


class BaseOdometry:
    """Publisher of odometry.

    Parameters: publish_rate 50, base_frame_id base_link, enable_odom_tf true, pose_ and twist_covariance_diagonal.
    """

    def __init__(self, context: ControllerContext, endpoints: Endpoints, *, frame: str) -> None:
        """Advertise.

        Args:
            context: controller's context.
            endpoints: endpoints to which the topic is added.
            frame: odometry frame.
        """
        settings = context.settings
        self._frame, self.base = frame, settings.text("base_frame_id", "base_link")
        self._covariances = tuple(covariance(settings, f"{name}_covariance_diagonal") for name in ("pose", "twist"))
        self._timer = PublishTimer(settings.number("publish_rate", 50.0, above=0.0))
        self._topic = context.node.advertise(f"{context.name}/odom", "nav_msgs/Odometry", queue_size=100)
        endpoints.add(self._topic)
        has_tf = settings.flag("enable_odom_tf", default=True)
        self._broadcaster = TransformBroadcaster(context.node) if has_tf else None

    def restart(self, time_ns: int) -> None:
        """Start a period now."""
        self._timer.restart(time_ns)

    @property
    def next_ns(self) -> float:
        """Time of the next message [ns]."""
        has_subscribers = self._broadcaster is not None or self._topic.has_subscribers
        return self._timer.next_ns if has_subscribers else math.inf

    def due(self, time_ns: int, dt: float) -> bool:
        """Return True if a message is due in a control period [s]; then start the next period."""
        self._timer.skip(time_ns, dt)
        return self._timer.due(time_ns)

    def publish(self, time_ns: int, pose: tuple[float, float, float], speed: tuple[float, float, float]) -> None:
        """Publish.

        Args:
            time_ns: stamp [ns].
            pose: x [m], y [m] and yaw [rad] in the odometry frame.
            speed: forward [m/s], left [m/s] and yaw rate [rad/s].
        """
        x, y, yaw = pose
        orientation = {"z": math.sin(yaw / 2), "w": math.cos(yaw / 2)}
        if self._topic.has_subscribers:
            pose_covariance, twist_covariance = self._covariances
            linear, angular = {"x": speed[0], "y": speed[1]}, {"z": speed[2]}
            self._topic.publish(
                {
                    "header": {"stamp": time_ns, "frame_id": self._frame},
                    "child_frame_id": self.base,
                    "pose": {
                        "pose": {"position": {"x": x, "y": y}, "orientation": orientation},
                        "covariance": pose_covariance,
                    },
                    "twist": {"twist": {"linear": linear, "angular": angular}, "covariance": twist_covariance},
                }
            )
        if self._broadcaster is not None:
            self._broadcaster.send_transform(
                Transform(
                    parent=self._frame,
                    child=self.base,
                    stamp_ns=time_ns,
                    translation=(x, y, 0.0),
                    rotation=(orientation["w"], 0.0, 0.0, orientation["z"]),
                )
            )
