"""Readings of instruments as messages, without their headers: barometers, altimeters, magnetometers, sonars, logical
cameras, radios."""

from trundle.sim.sensors import (
    AltimeterReading,
    LogicalCameraReading,
    MagnetometerReading,
    PressureReading,
    RfidReading,
    SonarReading,
    SonarSensor,
    WirelessReading,
)

_ULTRASOUND = 0
"""sensor_msgs/Range.ULTRASOUND"""


def pressure_message(reading: PressureReading) -> dict[str, object]:
    """sensor_msgs/FluidPressure: static pressure of a barometer, dynamic pressure of an air speed sensor."""
    return {"fluid_pressure": reading.pressure, "variance": reading.variance}


def altitude_message(reading: AltimeterReading) -> dict[str, object]:
    """geometry_msgs/Vector3Stamped in world axes: z above the start [m]."""
    return {"vector": {"z": reading.height}}


def vertical_velocity_message(reading: AltimeterReading) -> dict[str, object]:
    """geometry_msgs/Vector3Stamped in world axes: rate of z [m/s]."""
    return {"vector": {"z": reading.velocity}}


def field_message(reading: MagnetometerReading) -> dict[str, object]:
    """sensor_msgs/MagneticField."""
    return {"magnetic_field": dict(zip("xyz", reading.field, strict=True))}


def range_message(reading: SonarReading, sensor: SonarSensor) -> dict[str, object]:
    """sensor_msgs/Range along x of the frame."""
    return {
        "radiation_type": _ULTRASOUND,
        "field_of_view": sensor.fov_rad,
        "min_range": sensor.settings.min_m,
        "max_range": sensor.settings.max_m,
        "range": reading.range_m,
    }


def models_message(reading: LogicalCameraReading) -> dict[str, object]:
    """tf2_msgs/TFMessage: the pose of each model in view; each transform needs a header with the camera's frame."""
    transforms: list[dict[str, object]] = []
    for model in reading.models:
        qw, qx, qy, qz = model.camera_from_model.quaternion
        transform = {
            "translation": dict(zip("xyz", model.camera_from_model.position, strict=True)),
            "rotation": {"x": qx, "y": qy, "z": qz, "w": qw},
        }
        transforms.append({"child_frame_id": model.name, "transform": transform})
    return {"transforms": transforms}


def nodes_message(reading: WirelessReading) -> dict[str, object]:
    """diagnostic_msgs/DiagnosticArray: the transmitters received."""
    status = [
        {
            "name": signal.name,
            "values": [
                {"key": "frequency_mhz", "value": f"{signal.frequency_mhz:g}"},
                {"key": "signal_level_dbm", "value": f"{signal.level_dbm:.3f}"},
            ],
        }
        for signal in reading.signals
    ]
    return {"status": status}


def tags_message(reading: RfidReading) -> dict[str, object]:
    """diagnostic_msgs/DiagnosticArray: the tags in range."""
    return {"status": [{"name": tag} for tag in reading.tags]}
