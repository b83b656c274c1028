"""Fields of sensors, by type."""

import math

from trundle.base.xmlnode import XmlElement

from .field import Field, Section
from .shape_fields import NAME, POSE

_HALF_TURN = math.pi
_RAYS = ("ray", "gpu_ray", "lidar", "gpu_lidar")
_FORMATS = ("R8G8B8", "L8", "B8G8R8", "BAYER_RGGB8")
_DEPTH = ("depth", "depth_camera", "rgbd_camera")
SENSOR_TYPES = (
    "ray", "gpu_ray", "camera", "depth", "imu", "contact", "altimeter", "gps", "magnetometer", "sonar",
)  # fmt: skip
"""Types of sensors that can be added."""


def sensor_sections(sensor: XmlElement, collisions: tuple[str, ...]) -> list[Section]:
    """Return the sections of a <sensor>; `collisions` are the names of its link's collisions."""
    kind = sensor.get("type") or ""
    sensor_fields = (
        NAME,
        POSE,
        Field(name="update_rate", label="Rate", unit="Hz", minimum=0.0, maximum=1e5, default="0"),
        Field(name="always_on", label="Always on", kind="flag", default="false"),
        Field(name="visualize", label="Visualize", kind="flag", default="false"),
        Field(name="topic", label="Gazebo topic", kind="text"),
    )
    sections = [Section(title=f"Sensor: {kind}", fields=sensor_fields)]
    if kind in _RAYS:
        tag = next((tag for tag in ("ray", "lidar") if sensor.find(tag)), "ray")
        return [*sections, *_ray_sections(tag)]
    if kind in ("camera", "wideanglecamera", *_DEPTH):
        return [*sections, *_camera_sections()]
    if kind == "imu":
        return [*sections, _imu_section("angular_velocity"), _imu_section("linear_acceleration")]
    if kind == "contact":
        choice = Field(name="contact/collision", label="Collision", kind="choice", choices=collisions)
        return [*sections, Section(title="Contact", fields=(choice,))]
    return sections


def _ray_sections(tag: str) -> list[Section]:
    def scan(direction: str) -> tuple[Field, ...]:
        path = f"{tag}/scan/{direction}"
        return (
            Field(name=f"{path}/samples", label="Samples", minimum=1, maximum=1e5, default="1"),
            Field(
                name=f"{path}/min_angle", label="From", unit="rad", default="0", minimum=-_HALF_TURN, maximum=_HALF_TURN
            ),
            Field(
                name=f"{path}/max_angle", label="To", unit="rad", default="0", minimum=-_HALF_TURN, maximum=_HALF_TURN
            ),
        )

    reach = (
        Field(name=f"{tag}/range/min", label="Nearest", unit="m", minimum=0.0),
        Field(name=f"{tag}/range/max", label="Farthest", unit="m", minimum=0.0),
        Field(name=f"{tag}/range/resolution", label="Resolution", unit="m", minimum=0.0, default="0"),
        *_noise(f"{tag}/noise", "m"),
    )
    return [
        Section(title="Horizontal", fields=scan("horizontal")),
        Section(title="Vertical", fields=scan("vertical")),
        Section(title="Range", fields=reach),
    ]


def _camera_sections() -> list[Section]:
    fov = Field(
        name="camera/horizontal_fov", label="Horizontal FOV", unit="rad", minimum=0.01, maximum=3.14, default="1.047"
    )
    image = (
        fov,
        Field(name="camera/image/width", label="Width", unit="px", minimum=1, maximum=16384, default="320"),
        Field(name="camera/image/height", label="Height", unit="px", minimum=1, maximum=16384, default="240"),
        Field(name="camera/image/format", label="Format", kind="choice", choices=_FORMATS, default="R8G8B8"),
    )
    reach = (
        Field(name="camera/clip/near", label="Nearest", unit="m", minimum=1e-4, default="0.1"),
        Field(name="camera/clip/far", label="Farthest", unit="m", minimum=1e-3, default="100"),
        *_noise("camera/noise", ""),
    )
    return [Section(title="Image", fields=image), Section(title="Range", fields=reach)]


def _noise(path: str, unit: str) -> tuple[Field, ...]:
    return (Field(name=f"{path}/stddev", label="Noise σ", unit=unit, minimum=0.0, default="0"),)


def _imu_section(quantity: str) -> Section:
    unit = "rad/s" if quantity == "angular_velocity" else "m/s²"
    names = {axis: f"imu/{quantity}/{axis}/noise" for axis in "xyz"}
    fields = tuple(
        Field(name=f"{path}/stddev", label=f"Noise σ {axis}", unit=unit, minimum=0.0, default="0")
        for axis, path in names.items()
    )
    return Section(title=quantity.replace("_", " ").capitalize(), fields=fields)
