"""Velocity of a frame, from two of its poses."""

import numpy as np

import rospy

from . import transformations


def frame_twist(
    transformer, tracking, observation, reference, reference_point, reference_point_frame, time, averaging_interval
):
    """Linear and angular velocity of `tracking` seen from `observation`, in axes of `reference`.

    Args:
        transformer: has lookupTransform and getLatestCommonTime.
        tracking: moving frame.
        observation: frame that it moves in.
        reference: frame of the result's axes.
        reference_point: (x, y, z) where the linear velocity holds, in `reference_point_frame`.
        reference_point_frame: see there.
        time: rospy.Time in the middle of the interval; 0 is the latest.
        averaging_interval: rospy.Duration.

    Returns:
        Two 3-tuples [m/s], [rad/s].
    """
    latest = transformer.getLatestCommonTime(observation, tracking)
    middle = time or latest
    end = min(middle + rospy.Duration(averaging_interval.to_sec() / 2.0), latest)
    start = max(rospy.Time(0.0001) + averaging_interval, end) - averaging_interval
    interval_s = (end - start).to_sec()
    first, last = (_pose(transformer, observation, tracking, stamp) for stamp in (start, end))
    linear = (last[:3, 3] - first[:3, 3]) / interval_s
    angle, axis, _ = transformations.rotation_from_matrix(_rotation(last) @ _rotation(first).T)
    angular = axis * angle / interval_s
    reference_from_observation = _pose(transformer, reference, observation, middle)[:3, :3]
    linear, angular = reference_from_observation @ linear, reference_from_observation @ angular
    origin = _pose(transformer, reference, tracking, middle)[:3, 3]
    point = (_pose(transformer, reference, reference_point_frame, middle) @ (*reference_point, 1.0))[:3]
    return tuple((linear + np.cross(angular, point - origin)).tolist()), tuple(angular.tolist())


def _pose(transformer, target, source, stamp):
    translation, rotation = transformer.lookupTransform(target, source, stamp)
    return transformations.translation_matrix(translation) @ transformations.quaternion_matrix(rotation)


def _rotation(matrix):
    rotation = np.identity(4)
    rotation[:3, :3] = matrix[:3, :3]
    return rotation
