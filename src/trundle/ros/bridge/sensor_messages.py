"""Readings of sensors as messages, without their headers."""

import numpy as np

from trundle.sim.sensors import (
    ContactReading,
    ContactRecord,
    ForceTorqueReading,
    GpsReading,
    GpsSensor,
    ImuReading,
    RangeReading,
    directions_of,
)
from trundle.spatial import NS_PER_S, Vector3, Wrench

_FLOAT32 = 7
"""sensor_msgs/PointField.FLOAT32"""


def imu_message(reading: ImuReading) -> dict[str, object]:
    """sensor_msgs/Imu."""
    qw, qx, qy, qz = reading.orientation
    return {
        "orientation": {"x": qx, "y": qy, "z": qz, "w": qw},
        "angular_velocity": dict(zip("xyz", reading.angular_velocity, strict=True)),
        "linear_acceleration": dict(zip("xyz", reading.linear_acceleration, strict=True)),
    }


def scan_message(reading: RangeReading, period_s: float) -> dict[str, object]:
    """sensor_msgs/LaserScan of the first row of rays."""
    fan = reading.scan.horizontal
    return {
        "angle_min": fan.min_angle,
        "angle_max": fan.max_angle,
        "angle_increment": (fan.max_angle - fan.min_angle) / max(fan.values - 1, 1),
        "scan_time": period_s,
        "range_min": reading.scan.min_m,
        "range_max": reading.scan.max_m,
        "ranges": reading.ranges[0].astype(np.float32),
        "intensities": reading.intensities[0].astype(np.float32),
    }


def points_message(reading: RangeReading) -> dict[str, object]:
    """sensor_msgs/PointCloud2 in the sensor's frame [m], without the rays that hit nothing."""
    ranges = reading.ranges.reshape(-1)
    seen = np.isfinite(ranges)
    places = directions_of(reading.scan)[seen] * ranges[seen, None]
    points = np.column_stack([places, reading.intensities.reshape(-1)[seen]]).astype("<f4")
    return {
        "height": 1,
        "width": len(points),
        "fields": [
            {"name": name, "offset": 4 * i, "datatype": _FLOAT32, "count": 1}
            for i, name in enumerate(("x", "y", "z", "intensity"))
        ],
        "point_step": 16,
        "row_step": 16 * len(points),
        "data": np.frombuffer(points.tobytes(), dtype=np.uint8),
        "is_dense": True,
    }


def fix_message(reading: GpsReading, sensor: GpsSensor) -> dict[str, object]:
    """sensor_msgs/NavSatFix."""
    across, up = sensor.variances
    return {
        "status": {"status": 0, "service": 1},
        "latitude": reading.latitude_deg,
        "longitude": reading.longitude_deg,
        "altitude": reading.altitude,
        "position_covariance": [across, 0.0, 0.0, 0.0, across, 0.0, 0.0, 0.0, up],
        "position_covariance_type": 2,
    }


def wrench_message(reading: ForceTorqueReading) -> dict[str, object]:
    """geometry_msgs/WrenchStamped."""
    return {"wrench": _wrench(reading.wrench)}


def contacts_message(reading: ContactReading) -> dict[str, object]:
    """gazebo_msgs/ContactsState in the world frame; one state per step and pair of collisions."""
    found: dict[tuple[int, str, str], list[ContactRecord]] = {}
    for touch in reading.contacts:
        found.setdefault((touch.time_ns, touch.own, touch.other), []).append(touch)
    states: list[dict[str, object]] = []
    for (time_ns, own, other), touches in found.items():
        total = sum((touch.wrench for touch in touches), start=Wrench())
        states.append(
            {
                "info": f"time:{time_ns // NS_PER_S}.{time_ns % NS_PER_S:09}",
                "collision1_name": own,
                "collision2_name": other,
                "wrenches": [_wrench(touch.wrench) for touch in touches],
                "total_wrench": _wrench(total),
                "contact_positions": [_vector(touch.position) for touch in touches],
                "contact_normals": [_vector(touch.normal) for touch in touches],
                "depths": [touch.depth for touch in touches],
            }
        )
    return {"states": states}


def _wrench(wrench: Wrench) -> dict[str, object]:
    return {"force": _vector(wrench.force), "torque": _vector(wrench.torque)}


def _vector(vector: Vector3) -> dict[str, float]:
    return dict(zip("xyz", vector, strict=True))
