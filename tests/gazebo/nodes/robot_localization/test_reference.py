"""The filters as nodes against a plain reference, on a recorded drive with wheels, an imu and a position."""

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.gazebo.nodes.fakes import FakeClock, FakeNode, run_to_end

from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.robot_localization import EkfLocalization, UkfLocalization
from trundle.ros import to_nsec

Array = NDArray[np.float64]
START_NS = 1_000_000_000
NOISE = np.diag([0.05, 0.05, 0.06, 0.03, 0.03, 0.06, 0.025, 0.025, 0.04, 0.01, 0.01, 0.02, 0.01, 0.01, 0.015])
"""The original's process noise, per second."""


class Reading:
    """A message of the recording, and what it measures of the state."""

    def __init__(self, stamp_ns: int, topic: str, kind: str, fields: dict[str, Any], parts: list[Any]) -> None:
        self.stamp_ns, self.topic, self.kind, self.fields = stamp_ns, topic, kind, fields
        self.parts: list[tuple[list[int], list[float], Array]] = parts


def recording(seconds: float) -> list[Reading]:
    """A drive on bumpy ground: wheels at 50 Hz, an imu at 100 Hz with its own noise, a position at 2 Hz."""
    random = np.random.default_rng(4)
    readings: list[Reading] = []
    wheel, imu, rate, fix = np.diag([0.02, 0.03]), np.diag([0.001, 0.001, 0.002]), np.diag([0.01, 0.01, 0.004]), 0.3
    acceleration = np.diag([0.1, 0.1])
    for step in range(1, round(seconds * 100)):
        time, stamp_ns = step / 100, START_NS + step * 10_000_000
        speed, turn = 1.0 + 0.5 * math.sin(time), 0.4 * math.cos(0.5 * time)
        tilt = [0.1 * math.sin(3.0 * time), 0.08 * math.cos(2.0 * time)]
        yaw = 0.8 * math.sin(0.5 * time)
        angles = np.array([*tilt, yaw]) + random.normal(0.0, 0.03, 3)
        rates = np.array([0.3 * math.cos(3.0 * time), -0.16 * math.sin(2.0 * time), turn]) + random.normal(0.0, 0.1, 3)
        pushes = np.array([0.5 * math.cos(time), speed * turn]) + random.normal(0.0, 0.3, 2)
        readings.append(imu_reading(stamp_ns, angles, rates, pushes, imu, rate, acceleration))
        if step % 2 == 0:
            values = np.array([speed, turn]) + random.normal(0.0, 0.1, 2)
            readings.append(wheel_reading(stamp_ns + 1_000_000, values, wheel))
        if step % 50 == 0:
            place = np.array([time, math.sin(0.4 * time)]) + random.normal(0.0, 0.5, 2)
            readings.append(fix_reading(stamp_ns + 2_000_000, place, fix * np.eye(2)))
    return readings


def square(size: int, covariance: Array, indices: Sequence[int]) -> list[float]:
    full = np.zeros((size, size))
    full[np.ix_(list(indices), list(indices))] = covariance
    return full.ravel().tolist()


def imu_reading(stamp_ns: int, angles: Array, rates: Array, pushes: Array, *covariances: Array) -> Reading:
    (sr, sp, sy), (cr, cp, cy) = np.sin(angles / 2.0), np.cos(angles / 2.0)
    orientation = {
        "w": cr * cp * cy + sr * sp * sy,
        "x": sr * cp * cy - cr * sp * sy,
        "y": cr * sp * cy + sr * cp * sy,
        "z": cr * cp * sy - sr * sp * cy,
    }
    fields = {
        "header": {"stamp": stamp_ns, "frame_id": "base_link"},
        "orientation": orientation,
        "orientation_covariance": covariances[0].ravel().tolist(),
        "angular_velocity": dict(zip("xyz", rates.tolist(), strict=True)),
        "angular_velocity_covariance": covariances[1].ravel().tolist(),
        "linear_acceleration": dict(zip("xy", pushes.tolist(), strict=True)),
        "linear_acceleration_covariance": square(3, covariances[2], (0, 1)),
    }
    parts = [
        ([3, 4, 5], angles, covariances[0]),
        ([9, 10, 11], rates, covariances[1]),
        ([12, 13], pushes, covariances[2]),
    ]
    return Reading(stamp_ns, "/imu", "sensor_msgs/Imu", fields, parts)


def wheel_reading(stamp_ns: int, values: Array, covariance: Array) -> Reading:
    twist = {"linear": {"x": values[0]}, "angular": {"z": values[1]}}
    fields = {
        "header": {"stamp": stamp_ns, "frame_id": "odom"},
        "child_frame_id": "base_link",
        "twist": {"twist": twist, "covariance": square(6, covariance, (0, 5))},
    }
    return Reading(stamp_ns, "/wheels", "nav_msgs/Odometry", fields, [([6, 11], values, covariance)])


def fix_reading(stamp_ns: int, place: Array, covariance: Array) -> Reading:
    pose = {"position": {"x": place[0], "y": place[1]}, "orientation": {"w": 1.0}}
    header = {"stamp": stamp_ns, "frame_id": "odom"}
    fields = {"header": header, "pose": {"pose": pose, "covariance": square(6, covariance, (0, 1))}}
    kind = "geometry_msgs/PoseWithCovarianceStamped"
    return Reading(stamp_ns, "/fix", kind, fields, [([0, 1], place, covariance)])


# -- the reference: loops over the equations, without a shortcut


def moved(state: Sequence[Any], dt: float) -> list[Any]:
    """Return the state after a time: constant angular velocity and acceleration of the body, one Euler step."""
    x, y, z, roll, pitch, yaw, vx, vy, vz, wx, wy, wz, ax, ay, az = state
    sin, cos = np.sin, np.cos
    turn_z = [[cos(yaw), -sin(yaw), 0.0], [sin(yaw), cos(yaw), 0.0], [0.0, 0.0, 1.0]]
    turn_y = [[cos(pitch), 0.0, sin(pitch)], [0.0, 1.0, 0.0], [-sin(pitch), 0.0, cos(pitch)]]
    turn_x = [[1.0, 0.0, 0.0], [0.0, cos(roll), -sin(roll)], [0.0, sin(roll), cos(roll)]]
    rotation = np.array(turn_z) @ np.array(turn_y) @ np.array(turn_x)
    way = rotation @ np.array([v * dt + a * dt * dt / 2.0 for v, a in ((vx, ax), (vy, ay), (vz, az))])
    tan = sin(pitch) / cos(pitch)
    return [
        x + way[0],
        y + way[1],
        z + way[2],
        roll + (wx + sin(roll) * tan * wy + cos(roll) * tan * wz) * dt,
        pitch + (cos(roll) * wy - sin(roll) * wz) * dt,
        yaw + (sin(roll) / cos(pitch) * wy + cos(roll) / cos(pitch) * wz) * dt,
        vx + ax * dt,
        vy + ay * dt,
        vz + az * dt,
        wx,
        wy,
        wz,
        ax,
        ay,
        az,
    ]


def extended(state: Array, covariance: Array, dt: float) -> tuple[Array, Array]:
    """Predict with the exact Jacobian, by complex steps."""
    jacobian = np.zeros((15, 15))
    for column in range(15):
        shifted = state.astype(complex)
        shifted[column] += 1e-30j
        jacobian[:, column] = np.imag(np.array(moved(list(shifted), dt))) / 1e-30
    return np.array(moved(state.tolist(), dt)), jacobian @ covariance @ jacobian.T + NOISE * dt


def unscented(state: Array, covariance: Array, dt: float) -> tuple[Array, Array]:
    """Predict by 31 points; alpha 0.001 as the node's default, kappa 0, beta 2."""
    alpha, beta, count = 0.001, 2.0, 15
    scale = alpha**2 * count
    root = np.linalg.cholesky(scale * covariance)
    points = [state, *(state + root[:, i] for i in range(count)), *(state - root[:, i] for i in range(count))]
    after = [np.array(moved(point.tolist(), dt)) for point in points]
    first = 1.0 - count / scale
    mean = after[0] + sum(point - after[0] for point in after[1:]) / (2.0 * scale)
    spread = (first + 1.0 - alpha**2 + beta) * np.outer(after[0] - mean, after[0] - mean)
    spread += sum(np.outer(point - mean, point - mean) for point in after[1:]) / (2.0 * scale)
    return mean, spread + NOISE * dt


def reference(
    readings: list[Reading], predict: Callable[[Array, Array, float], tuple[Array, Array]]
) -> dict[int, tuple[Array, Array]]:
    """Return stamp → state and covariance after all that was measured then."""
    state, covariance, last_ns = np.zeros(15), 1e-9 * np.eye(15), 0
    results: dict[int, tuple[Array, Array]] = {}
    for reading in sorted(readings, key=lambda reading: reading.stamp_ns):
        for indices, values, noise in reading.parts:
            if last_ns == 0:
                state[indices] = values
                covariance[np.ix_(indices, indices)] = noise
                last_ns = reading.stamp_ns
                continue
            if reading.stamp_ns > last_ns:
                state, covariance = predict(state, covariance, (reading.stamp_ns - last_ns) / 1e9)
                last_ns = reading.stamp_ns
            selection = np.eye(15)[indices]
            gain = covariance @ selection.T @ np.linalg.inv(selection @ covariance @ selection.T + noise)
            error = np.array(values) - selection @ state
            for row, index in enumerate(indices):
                if index in (3, 4, 5):
                    error[row] = math.remainder(error[row], math.tau)
            state = state + gain @ error
            covariance = (np.eye(15) - gain @ selection) @ covariance
        results[reading.stamp_ns] = (state.copy(), covariance.copy())
    return results


def run_node(kind: type[EkfLocalization], readings: list[Reading], seconds: float) -> list[Any]:
    """Play the recording to a node; returns what it publishes."""
    waiting = sorted(readings, key=lambda reading: reading.stamp_ns)

    def play() -> int:
        while waiting and waiting[0].stamp_ns <= clock.ns:
            reading = waiting.pop(0)
            node.receive(reading.topic, reading.fields, reading.kind)
        return 0

    clock = FakeClock(start_ns=START_NS, end_ns=START_NS + round(seconds * 1e9), late_ns=play)

    def mask(*used: int) -> list[bool]:
        return [index in used for index in range(15)]

    params = {
        "imu0": "/imu",
        "imu0_config": mask(3, 4, 5, 9, 10, 11, 12, 13),
        "odom0": "/wheels",
        "odom0_config": mask(6, 11),
        "pose0": "/fix",
        "pose0_config": mask(0, 1),
        "frequency": 20.0,
        "sensor_timeout": 10.0,
    }
    node: Any = FakeNode(clock, params)
    run_to_end(kind(node, [], NodeHost()).run())
    return node.sent("/odometry/filtered")


@pytest.mark.parametrize(("kind", "predict"), [(EkfLocalization, extended), (UkfLocalization, unscented)])
def test_a_recorded_drive_gives_the_estimates_of_the_reference(kind: Any, predict: Any) -> None:
    readings = recording(2.5)
    expected = reference(readings, predict)
    sent = run_node(kind, readings, 2.5)

    assert len(sent) > 40
    for message in sent[2:]:
        state, covariance = expected[to_nsec(message.header.stamp)]
        position, q, twist = message.pose.pose.position, message.pose.pose.orientation, message.twist.twist
        assert (position.x, position.y, position.z) == pytest.approx(state[:3], abs=1e-6)
        w, x, y, z = q.w, q.x, q.y, q.z
        roll = math.atan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y))
        yaw = math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
        assert (roll, math.asin(2.0 * (w * y - z * x)), yaw) == pytest.approx(state[3:6], abs=1e-6)
        speeds = (twist.linear.x, twist.linear.y, twist.linear.z, twist.angular.x, twist.angular.y, twist.angular.z)
        assert speeds == pytest.approx(state[6:12], abs=1e-6)
        assert np.array(message.pose.covariance) == pytest.approx(covariance[:6, :6].ravel(), rel=1e-4, abs=1e-8)
        assert np.array(message.twist.covariance) == pytest.approx(covariance[6:12, 6:12].ravel(), rel=1e-4, abs=1e-8)


def test_both_filters_agree_on_a_gentle_drive_but_not_to_the_last_digit() -> None:
    readings = recording(1.5)
    last = [run_node(kind, readings, 1.5)[-1].pose.pose.position for kind in (EkfLocalization, UkfLocalization)]
    assert last[0].x == pytest.approx(last[1].x, abs=0.01)
    assert last[0].x != last[1].x
