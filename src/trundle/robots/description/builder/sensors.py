"""Builder of sensors: SDF's types and their settings."""

from typing import TypeAlias

from trundle.base.diagnostics import UsageError, no_such
from trundle.robots.model import (
    MEASURING,
    AirPressure,
    AirSpeed,
    Altimeter,
    CameraOptics,
    ForceTorque,
    GpsNoise,
    ImuNoise,
    LogicalCamera,
    Magnetometer,
    RangeScan,
    Sensor,
    Sonar,
    Transceiver,
)
from trundle.spatial import Pose

from ..sdf.camera import CAMERA_TYPES
from .names import BUILT

SensorSettings: TypeAlias = (
    AirPressure
    | AirSpeed
    | Altimeter
    | CameraOptics
    | ForceTorque
    | GpsNoise
    | ImuNoise
    | LogicalCamera
    | Magnetometer
    | RangeScan
    | Sonar
    | Transceiver
)
"""Settings of a sensor, all from `trundle.robots.model`, with SDF's defaults."""

SETTINGS: dict[str, type[SensorSettings]] = {
    **dict.fromkeys(CAMERA_TYPES, CameraOptics),
    **dict.fromkeys(("ray", "gpu_ray", "lidar", "gpu_lidar"), RangeScan),
    **dict.fromkeys(("gps", "navsat"), GpsNoise),
    **dict.fromkeys(("wireless_receiver", "wireless_transmitter"), Transceiver),
    "air_pressure": AirPressure,
    "air_speed": AirSpeed,
    "altimeter": Altimeter,
    "force_torque": ForceTorque,
    "imu": ImuNoise,
    "logical_camera": LogicalCamera,
    "magnetometer": Magnetometer,
    "sonar": Sonar,
}
"""Type of sensor → its settings; the other types have none."""


def make_sensor(
    name: str,
    type_: str,
    settings: SensorSettings | None,
    *,
    pose: Pose,
    update_rate: float,
    always_on: bool,
    visualize: bool,
    topic: str,
) -> Sensor:
    """Return a sensor with the settings of its type.

    Raises:
        UsageError: unknown type, or settings of another type.
    """
    types = CAMERA_TYPES | MEASURING
    if type_ not in types:
        raise UsageError(no_such(f"sensor {name!r}: no type", type_, sorted(types)))
    settings_type = SETTINGS.get(type_)
    if settings is None and settings_type is not None:
        settings = settings_type()
    if settings is not None and (settings_type is None or not isinstance(settings, settings_type)):
        expected = "no settings" if settings_type is None else f"settings of {settings_type.__name__}"
        raise UsageError(f"sensor {name!r}: type {type_!r} takes {expected}, not {type(settings).__name__}")
    return Sensor(
        name=name,
        type=type_,
        at=BUILT,
        link_from_sensor=pose,
        update_rate_hz=update_rate,
        always_on=always_on,
        visualize=visualize,
        topic=topic,
        contact_collisions=() if type_ == "contact" else None,
        cameras=(settings,) if isinstance(settings, CameraOptics) else (),
        scan=settings if isinstance(settings, RangeScan) else None,
        imu=settings if isinstance(settings, ImuNoise) else None,
        gps=settings if isinstance(settings, GpsNoise) else None,
        force_torque=settings if isinstance(settings, ForceTorque) else None,
        instrument=settings
        if isinstance(settings, AirPressure | AirSpeed | Altimeter | LogicalCamera | Magnetometer | Sonar | Transceiver)
        else None,
    )
