"""The filter against motions known from mechanics, and against a batch solution."""

import math

import numpy as np
import pytest

from trundle.gazebo.nodes.robot_localization.kalman import SIZE, KalmanFilter, Measurement, wrap_angles
from trundle.spatial import matrix_from_quaternion, quaternion_from_axis_angle, quaternion_from_rpy

NONE = np.zeros((SIZE, SIZE))


def filter_at(*, noise: float = 0.0, variance: float = 1.0, **elements: float) -> KalmanFilter:
    names = "x y z roll pitch yaw vx vy vz wx wy wz ax ay az".split()  # noqa: SIM905
    state = [elements.get(name, 0.0) for name in names]
    return KalmanFilter(process_noise=noise * np.eye(SIZE), covariance=variance * np.eye(SIZE), state=state)


def measured(values: dict[int, float], variance: float, **more: float) -> Measurement:
    size = len(values)
    return Measurement(
        stamp_ns=0,
        indices=tuple(values),
        values=np.array(list(values.values())),
        covariance=variance * np.eye(size),
        **more,
    )


def test_a_turning_body_drives_a_circle() -> None:
    """1 m/s at 0.5 rad/s: after half a turn it is 4 m to the left, and faces backward."""
    body = filter_at(vx=1.0, wz=0.5)
    for _ in range(1000):
        body.predict(2.0 * math.pi / 1000)
    assert body.state[:2] == pytest.approx((0.0, 4.0), abs=0.02)
    assert abs(body.state[5]) == pytest.approx(math.pi, abs=1e-6)


def test_orientation_follows_the_body_s_angular_velocity() -> None:
    """Turning about a fixed axis of the body, from a tilted start: Rodrigues' formula."""
    body = filter_at(roll=0.3, pitch=-0.4, yaw=1.0, wx=0.2, wy=-0.3, wz=0.6)
    for _ in range(2000):
        body.predict(0.0005)
    start = matrix_from_quaternion(quaternion_from_rpy(0.3, -0.4, 1.0))
    axis = np.array([0.2, -0.3, 0.6])
    turn = quaternion_from_axis_angle(tuple(axis / np.linalg.norm(axis)), float(np.linalg.norm(axis)))
    end = matrix_from_quaternion(quaternion_from_rpy(*body.state[3:6]))
    assert end == pytest.approx(start @ matrix_from_quaternion(turn), abs=1e-3)


def test_a_falling_body_accelerates() -> None:
    body = filter_at(vx=2.0, az=-9.81)
    body.predict(2.0)
    assert body.state[[0, 2, 8]] == pytest.approx((4.0, -19.62, -19.62))


def test_uncertain_speed_becomes_uncertain_position() -> None:
    body = filter_at(variance=0.0)
    body.covariance[6, 6] = 0.04
    body.predict(3.0)
    assert body.covariance[0, 0] == pytest.approx(0.36)
    assert body.covariance[0, 6] == pytest.approx(0.12)


def test_repeated_measurements_give_their_mean_and_its_variance() -> None:
    """A prior of variance 1 at 0 and n measurements of variance s²: the Gaussian posterior."""
    body, values = filter_at(variance=1.0), [2.0, 2.5, 1.5, 2.2]
    for value in values:
        assert body.correct(measured({0: value}, 0.5))
    precision = 1.0 + len(values) / 0.5
    assert body.state[0] == pytest.approx(sum(values) / 0.5 / precision)
    assert body.covariance[0, 0] == pytest.approx(1.0 / precision)
    assert body.covariance == pytest.approx(body.covariance.T)


def test_headings_on_both_sides_of_pi_average_to_pi() -> None:
    body = filter_at(variance=1.0, yaw=math.pi - 0.1)
    body.correct(measured({5: -math.pi + 0.1}, 1.0))
    assert wrap_angles(body.state[5:6] - math.pi)[0] == pytest.approx(0.0, abs=1e-9)


def test_an_outlier_is_rejected_beyond_its_threshold() -> None:
    body = filter_at(variance=1.0)
    assert not body.correct(measured({0: 10.0}, 1.0, max_distance=5.0))
    assert body.state[0] == 0.0
    assert body.correct(measured({0: 7.0}, 1.0, max_distance=5.0))


def test_exact_measurements_keep_the_covariance_positive() -> None:
    body = filter_at(variance=1e-9)
    for _ in range(100):
        body.correct(measured({0: 1.0, 5: 0.5}, 0.0))
        body.predict(0.02)
    assert np.linalg.eigvalsh(body.covariance).min() > -1e-12
    assert np.isfinite(body.state).all()
