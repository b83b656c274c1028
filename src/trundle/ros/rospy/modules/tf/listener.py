"""Lookup of transforms with tf's interface, and listener that receives them."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
import yaml

import genpy
import rospy
import tf2_ros

from . import transformations
from .message_transforms import MessageTransforms, xyz_to_mat44, xyzw_to_mat44

if TYPE_CHECKING:
    from numpy.typing import NDArray

__all__ = [
    "TransformListener",
    "Transformer",
    "TransformerROS",
    "strip_leading_slash",
    "xyz_to_mat44",
    "xyzw_to_mat44",
]


_Twist = tuple[tuple[float, float, float], tuple[float, float, float]]
"""Linear [m/s] and angular [rad/s] velocity."""


def strip_leading_slash(s: str) -> str:
    """Frame name as in tf2."""
    return s[1:] if s.startswith("/") else s


class Transformer:
    """Buffer of transforms; frame names may start with a slash."""

    def __init__(self, interpolate: bool = True, cache_time: genpy.Duration | None = None) -> None:
        """Start empty.

        Args:
            interpolate: no effect; tf2 always interpolates.
            cache_time: rospy.Duration to keep transforms for; None: 10 s.
        """
        del interpolate
        self._buffer = tf2_ros.Buffer(cache_time, debug=False)
        self._using_dedicated_thread = False

    def allFramesAsDot(self, current_time: genpy.Time | None = None) -> str:
        """The tree of frames for Graphviz."""
        return self._buffer._allFramesAsDot(current_time) if current_time else self._buffer._allFramesAsDot()

    def allFramesAsString(self) -> str:
        """Description of the tree, with a sentence for each frame."""
        return self._buffer.all_frames_as_string()

    def setTransform(self, transform: Any, authority: str = "default_authority") -> None:
        """Add a TransformStamped."""
        self._buffer.set_transform(transform, authority)

    def canTransform(self, target_frame: str, source_frame: str, time: genpy.Time) -> bool:
        """True if `lookupTransform` would succeed."""
        return self._buffer.can_transform(strip_leading_slash(target_frame), strip_leading_slash(source_frame), time)

    def canTransformFull(
        self, target_frame: str, target_time: genpy.Time, source_frame: str, source_time: genpy.Time, fixed_frame: str
    ) -> bool:
        """True if `lookupTransformFull` would succeed."""
        return self._buffer.can_transform_full(
            strip_leading_slash(target_frame),
            target_time,
            strip_leading_slash(source_frame),
            source_time,
            strip_leading_slash(fixed_frame),
        )

    def waitForTransform(
        self,
        target_frame: str,
        source_frame: str,
        time: genpy.Time,
        timeout: genpy.Duration,
        polling_sleep_duration: object = None,
    ) -> None:
        """Wait for a transform.

        Raises:
            tf.Exception: timeout, or nothing listens to /tf.
        """
        del polling_sleep_duration
        self._check_listening()
        self._check_success(
            self._buffer.can_transform(
                strip_leading_slash(target_frame),
                strip_leading_slash(source_frame),
                time,
                timeout,
                return_debug_tuple=True,
            ),
            source_frame,
            target_frame,
        )

    def waitForTransformFull(
        self,
        target_frame: str,
        target_time: genpy.Time,
        source_frame: str,
        source_time: genpy.Time,
        fixed_frame: str,
        timeout: genpy.Duration,
        polling_sleep_duration: object = None,
    ) -> None:
        """Wait for a transform between two times; see `waitForTransform`."""
        del polling_sleep_duration
        self._check_listening()
        self._check_success(
            self._buffer.can_transform_full(
                strip_leading_slash(target_frame),
                target_time,
                strip_leading_slash(source_frame),
                source_time,
                strip_leading_slash(fixed_frame),
                timeout,
                return_debug_tuple=True,
            ),
            source_frame,
            target_frame,
        )

    def chain(
        self, target_frame: str, target_time: genpy.Time, source_frame: str, source_time: genpy.Time, fixed_frame: str
    ) -> list[str]:
        """Frames from the source to the target, along the tree."""
        return self._buffer._chain(target_frame, target_time, source_frame, source_time, fixed_frame)

    def clear(self) -> None:
        """Drop all but static transforms."""
        self._buffer.clear()

    def frameExists(self, frame_id: str) -> bool:
        """True if the frame has a parent."""
        return frame_id in self.getFrameStrings()

    def getFrameStrings(self) -> list[str]:
        """Names of the frames that have a parent."""
        return list(yaml.safe_load(self._buffer.all_frames_as_yaml()) or {})

    def getLatestCommonTime(self, source_frame: str, dest_frame: str) -> rospy.Time:
        """Newest rospy.Time at which the two are connected."""
        return self._buffer.get_latest_common_time(strip_leading_slash(source_frame), strip_leading_slash(dest_frame))

    def lookupTransform(
        self, target_frame: str, source_frame: str, time: genpy.Time
    ) -> tuple[list[float], list[float]]:
        """Translation [x, y, z] and rotation [x, y, z, w] of the source in the target frame.

        Raises:
            tf.LookupException: no such frame.
            tf.ConnectivityException: not in one tree.
            tf.ExtrapolationException: not at this time.
        """
        return _as_lists(
            self._buffer.lookup_transform(strip_leading_slash(target_frame), strip_leading_slash(source_frame), time)
        )

    def lookupTransformFull(
        self, target_frame: str, target_time: genpy.Time, source_frame: str, source_time: genpy.Time, fixed_frame: str
    ) -> tuple[list[float], list[float]]:
        """Translation and rotation between two times; see `lookupTransform`."""
        return _as_lists(
            self._buffer.lookup_transform_full(
                strip_leading_slash(target_frame),
                target_time,
                strip_leading_slash(source_frame),
                source_time,
                strip_leading_slash(fixed_frame),
            )
        )

    def lookupTwist(
        self, tracking_frame: str, observation_frame: str, time: genpy.Time, averaging_interval: genpy.Duration
    ) -> "_Twist":
        """Linear [m/s] and angular [rad/s] velocity of a frame as seen from another, as two 3-tuples."""
        return self.lookupTwistFull(
            tracking_frame,
            observation_frame,
            observation_frame,
            (0.0, 0.0, 0.0),
            tracking_frame,
            time,
            averaging_interval,
        )

    def lookupTwistFull(
        self,
        tracking_frame: str,
        observation_frame: str,
        reference_frame: str,
        ref_point: Sequence[float],
        reference_point_frame: str,
        time: genpy.Time,
        averaging_interval: genpy.Duration,
    ) -> "_Twist":
        """Velocity of a frame at a reference point, in a reference frame, averaged over an interval."""
        return _frame_twist(
            self,
            tracking_frame,
            observation_frame,
            reference_frame,
            ref_point,
            reference_point_frame,
            time,
            averaging_interval,
        )

    def setUsingDedicatedThread(self, value: bool) -> None:
        """Declare that another thread receives transforms, which waiting requires."""
        self._using_dedicated_thread = value

    def getTFPrefix(self) -> str:
        """''; tf2 has no prefix."""
        return ""

    def _check_listening(self) -> None:
        if not self._using_dedicated_thread:
            raise tf2_ros.TransformException(
                "a Transformer cannot wait unless another thread adds transforms: use a TransformListener, or "
                "setUsingDedicatedThread"
            )

    def _check_success(self, result: tuple[int, str], source_frame: str, target_frame: str) -> None:
        is_possible, why = result
        if not is_possible:
            raise tf2_ros.TransformException(why or f"no transform from '{source_frame}' to '{target_frame}'")


class TransformerROS(Transformer, MessageTransforms):
    """Transformer that also transforms stamped messages."""


class TransformListener(TransformerROS):
    """Transformer that receives /tf and /tf_static."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        """Subscribe; arguments: see Transformer."""
        super().__init__(*args, **kwargs)
        self._listener = tf2_ros.TransformListener(self._buffer)
        self.setUsingDedicatedThread(True)


def _as_lists(message: Any) -> tuple[list[float], list[float]]:
    t, r = message.transform.translation, message.transform.rotation
    return [t.x, t.y, t.z], [r.x, r.y, r.z, r.w]


def _frame_twist(
    transformer: Transformer,
    tracking: str,
    observation: str,
    reference: str,
    reference_point: Sequence[float],
    reference_point_frame: str,
    time: genpy.Time,
    averaging_interval: genpy.Duration,
) -> "_Twist":
    """Linear and angular velocity of `tracking` seen from `observation`, in axes of `reference`.

    Args:
        transformer: source of the transforms.
        tracking: moving frame.
        observation: frame in which it moves.
        reference: frame of the result's axes.
        reference_point: (x, y, z) where the linear velocity holds, in `reference_point_frame`.
        reference_point_frame: frame of `reference_point`.
        time: middle of the interval; 0: latest.
        averaging_interval: length of the interval.

    Returns:
        Two 3-tuples [m/s], [rad/s].
    """
    latest = transformer.getLatestCommonTime(observation, tracking)
    middle = time or latest
    end = min(middle + rospy.Duration(averaging_interval.to_sec() / 2.0), latest)
    start = max(rospy.Time(0.0001) + averaging_interval, end) - averaging_interval
    interval_s = (end - start).to_sec()
    first, last = (_pose(transformer, observation, tracking, stamp) for stamp in (start, end))
    linear: NDArray[np.float64] = (last[:3, 3] - first[:3, 3]) / interval_s
    angle, axis, _ = transformations.rotation_from_matrix(_rotation(last) @ _rotation(first).T)
    angular = axis * angle / interval_s
    reference_from_observation = _pose(transformer, reference, observation, middle)[:3, :3]
    linear, angular = reference_from_observation @ linear, reference_from_observation @ angular
    origin = _pose(transformer, reference, tracking, middle)[:3, 3]
    point = (_pose(transformer, reference, reference_point_frame, middle) @ (*reference_point, 1.0))[:3]
    vx, vy, vz = (linear + np.cross(angular, point - origin)).tolist()
    wx, wy, wz = angular.tolist()
    return (vx, vy, vz), (wx, wy, wz)


def _pose(transformer: Transformer, target: str, source: str, stamp: genpy.Time) -> "NDArray[np.float64]":
    translation, rotation = transformer.lookupTransform(target, source, stamp)
    return transformations.translation_matrix(translation) @ transformations.quaternion_matrix(rotation)


def _rotation(matrix: "NDArray[np.float64]") -> "NDArray[np.float64]":
    rotation = np.identity(4)
    rotation[:3, :3] = matrix[:3, :3]
    return rotation
