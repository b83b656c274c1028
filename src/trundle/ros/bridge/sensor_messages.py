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
    horizontal = reading.scan.horizontal
    return {
        "angle_min": horizontal.min_angle,
        "angle_max": horizontal.max_angle,
        "angle_increment": (horizontal.max_angle - horizontal.min_angle) / max(horizontal.values - 1, 1),
        "scan_time": period_s,
        "range_min": reading.scan.min_m,
        "range_max": reading.scan.max_m,
        "ranges": reading.ranges[0].astype(np.float32),
        "intensities": reading.intensities[0].astype(np.float32),
    }


def points_message(reading: RangeReading) -> dict[str, object]:
    """sensor_msgs/PointCloud2 in the sensor's frame [m], without the rays that hit nothing."""
    ranges = reading.ranges.reshape(-1)
    is_hit = np.isfinite(ranges)
    positions = directions_of(reading.scan)[is_hit] * ranges[is_hit, None]
    points = np.column_stack([positions, reading.intensities.reshape(-1)[is_hit]]).astype("<f4")
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
    horizontal, vertical = sensor.variances
    return {
        "status": {"status": 0, "service": 1},
        "latitude": reading.latitude_deg,
        "longitude": reading.longitude_deg,
        "altitude": reading.altitude,
        "position_covariance": [horizontal, 0.0, 0.0, 0.0, horizontal, 0.0, 0.0, 0.0, vertical],
        "position_covariance_type": 2,
    }


def wrench_message(reading: ForceTorqueReading) -> dict[str, object]:
    """geometry_msgs/WrenchStamped."""
    return {"wrench": _wrench(reading.wrench)}


def contacts_message(reading: ContactReading) -> dict[str, object]:
    """gazebo_msgs/ContactsState in the world frame; one state per step and pair of collisions."""
    groups: dict[tuple[int, str, str], list[ContactRecord]] = {}
    for contact in reading.contacts:
        groups.setdefault((contact.time_ns, contact.collision, contact.other), []).append(contact)
    states: list[dict[str, object]] = []
    for (time_ns, collision1, collision2), contacts in groups.items():
        total = sum((contact.wrench for contact in contacts), start=Wrench())
        states.append(
            {
                "info": f"time:{time_ns // NS_PER_S}.{time_ns % NS_PER_S:09}",
                "collision1_name": collision1,
                "collision2_name": collision2,
                "wrenches": [_wrench(contact.wrench) for contact in contacts],
                "total_wrench": _wrench(total),
                "contact_positions": [_vector(contact.position) for contact in contacts],
                "contact_normals": [_vector(contact.normal) for contact in contacts],
                "depths": [contact.depth for contact in contacts],
            }
        )
    return {"states": states}


def _wrench(wrench: Wrench) -> dict[str, object]:
    return {"force": _vector(wrench.force), "torque": _vector(wrench.torque)}


def _vector(vector: Vector3) -> dict[str, float]:
    return dict(zip("xyz", vector, strict=True))
