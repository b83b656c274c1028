"""Readers of settings and noise of sensors other than cameras."""

from msgspec.structs import replace

from trundle.base.xmlnode import XmlNode
from trundle.robots.model import (
    ForceTorque,
    GpsNoise,
    ImuNoise,
    Noise,
    OrientationReference,
    RangeScan,
    ScanAxis,
    Sensor,
)

from .context import Context, read_bits, warn_ignored
from .instrument import read_instrument
from .noise import read_noise

_MAX_RAYS = 2_000_000


def with_settings(sensor: Sensor, node: XmlNode, context: Context) -> Sensor:
    """Return a sensor with the settings of its type."""
    match sensor.type:
        case "ray" | "gpu_ray" | "lidar" | "gpu_lidar":
            return replace(sensor, scan=read_scan(node, context))
        case "imu":
            return replace(sensor, imu=read_imu(node, context))
        case "gps" | "navsat":
            return replace(sensor, gps=read_gps(node, context))
        case "force_torque":
            return replace(sensor, force_torque=read_force_torque(node, context))
        case "contact":
            return replace(sensor, contact_collisions=read_contact(node, context))
        case type_:
            return replace(sensor, instrument=read_instrument(node, type_, context))


def read_scan(sensor: XmlNode, context: Context) -> RangeScan:
    """Read <ray> or <lidar>; too many rays are reduced with a warning."""
    report = context.report
    node = sensor.find("ray") or sensor.find("lidar")
    if node is None:
        report.warn(
            sensor.at, f"sensor {sensor.attribute('name')!r} has no <ray>; its range is 0", "incomplete-element"
        )
        return RangeScan()
    scan, limits = node.find("scan"), node.find("range")
    horizontal, vertical = (_axis(scan, tag, context) for tag in ("horizontal", "vertical"))
    low = 0.0 if limits is None else max(0.0, limits.number("min", default=0.0))
    high = 0.0 if limits is None else limits.number("max", default=0.0)
    if not high > low:
        report.warn(node.at, f"range min {low:g}, max {high:g} is empty; the sensor measures nothing", "out-of-range")
    if horizontal.values * vertical.values > _MAX_RAYS:
        report.warn(
            node.at,
            f"{horizontal.values} x {vertical.values} rays are too many; one row of 640 is cast",
            "out-of-range",
        )
        horizontal, vertical = ScanAxis(samples=640, min_angle=-1.0, max_angle=1.0), ScanAxis()
    result = RangeScan(
        horizontal=horizontal,
        vertical=vertical,
        min_m=low,
        max_m=high,
        noise=read_noise(node.find("noise"), context),
        visibility_mask=read_bits(node, "visibility_mask"),
    )
    if limits is not None:
        warn_ignored(limits, ("resolution",), "has no effect, as in Gazebo", context)
        limits.report_unread(report)
    if scan is not None:
        scan.report_unread(report)
    node.report_unread(report)
    return result


def _axis(scan: XmlNode | None, tag: str, context: Context) -> ScanAxis:
    node = None if scan is None else scan.find(tag)
    if node is None:
        return ScanAxis(samples=640 if tag == "horizontal" else 1)
    report = context.report
    axis = ScanAxis(
        samples=_samples(node, 640 if tag == "horizontal" else 1, context),
        resolution=_resolution(node, context),
        min_angle=node.number("min_angle", default=0.0),
        max_angle=node.number("max_angle", default=0.0),
    )
    node.report_unread(report)
    return axis


def _samples(node: XmlNode, default: int, context: Context) -> int:
    samples = node.integer("samples", default=default)
    if samples > 0:
        return samples
    context.report.warn(node.at, f"{samples} samples is not possible; 1 is used", "out-of-range")
    return 1


def _resolution(node: XmlNode, context: Context) -> float:
    resolution = node.number("resolution", default=1.0)
    if resolution > 0.0:
        return resolution
    context.report.warn(
        node.at, f"a resolution of {resolution:g} values per sample is not possible; 1 is used", "out-of-range"
    )
    return 1.0


def read_imu(sensor: XmlNode, context: Context) -> ImuNoise:
    """Read <imu>: noise per axis in SDF 1.6, one noise for all rates and one for all accelerations in 1.4 and 1.5."""
    node = sensor.find("imu")
    if node is None:
        return ImuNoise()
    old = node.find("noise")
    if old is not None and old.string("type") == "none":
        old = None
    rates = _axes(node, "angular_velocity", None if old is None else old.find("rate"), context)
    accelerations = _axes(node, "linear_acceleration", None if old is None else old.find("accel"), context)
    reference = _reference(node.find("orientation_reference_frame"), context)
    warn_ignored(node, ("enable_orientation",), "has no effect: the orientation is always published", context)
    node.report_unread(context.report)
    return ImuNoise(angular_velocity=rates, linear_acceleration=accelerations, reference=reference)


_LOCALIZATIONS = ("CUSTOM", "ENU", "NED", "NWU", "GRAV_UP", "GRAV_DOWN")


def _reference(node: XmlNode | None, context: Context) -> OrientationReference | None:
    if node is None:
        return None
    report, default = context.report, OrientationReference()
    localization = node.string("localization").upper() or default.localization
    custom, gravity = node.find("custom_rpy"), node.find("grav_dir_x")
    reference = OrientationReference(
        localization=localization,
        custom_rpy=node.vector("custom_rpy", default=default.custom_rpy),
        parent_frame=_parent(custom, context),
        gravity_x=node.vector("grav_dir_x", default=default.gravity_x),
        gravity_parent_frame=_parent(gravity, context),
    )
    node.report_unread(report)
    if localization not in _LOCALIZATIONS:
        names = ", ".join(_LOCALIZATIONS)
        report.warn(
            node.at,
            f"no localization {localization!r}: {names}; the orientation is relative to the start",
            "unknown-choice",
        )
        return None
    return reference


def _parent(node: XmlNode | None, context: Context) -> str:
    frame = "" if node is None else node.attribute("parent_frame") or ""
    if node is not None and frame not in ("", "world"):
        context.report.warn(
            node.at, f"parent_frame {frame!r} is neither 'world' nor empty; the world is used", "unknown-choice"
        )
        return "world"
    return frame


def read_gps(sensor: XmlNode, context: Context) -> GpsNoise:
    """Read <gps> or <navsat>; velocities are not published, so their noise is ignored."""
    node = sensor.find("gps") or sensor.find("navsat")
    if node is None:
        return GpsNoise()
    position = node.find("position_sensing")
    warn_ignored(node, ("velocity_sensing",), "has no effect: velocities are not published", context)
    node.report_unread(context.report)
    if position is None:
        return GpsNoise()
    horizontal, vertical = (
        None if (axis := position.find(tag)) is None else axis.find("noise") for tag in ("horizontal", "vertical")
    )
    return GpsNoise(horizontal=read_noise(horizontal, context), vertical=read_noise(vertical, context))


def read_contact(sensor: XmlNode, context: Context) -> tuple[str, ...]:
    """Read <contact>: collisions of the sensor's own link, by name or by `model::link::collision`."""
    node = sensor.find("contact")
    if node is None:
        return ()
    names = [child.text.rpartition("::")[2] for child in node.all("collision")]
    node.report_unread(context.report)
    return tuple(name for name in names if name not in ("", "__default__"))


def read_force_torque(sensor: XmlNode, context: Context) -> ForceTorque:
    """Read <force_torque>; before SDF 1.5 the default frame is the parent's."""
    node = sensor.find("force_torque") or sensor.find("forcetorque")
    default = "parent" if context.version < (1, 5) else "child"
    if node is None:
        return ForceTorque(frame=default)
    frame = node.string("frame") or default
    if frame not in ("child", "parent", "sensor"):
        context.report.warn(
            node.at, f"no frame {frame!r} for forces: child, parent or sensor; child is used", "unknown-choice"
        )
        frame = "child"
    direction = node.string("measure_direction") or "child_to_parent"
    if direction not in ("child_to_parent", "parent_to_child"):
        fault = f"no measure_direction {direction!r}: child_to_parent or parent_to_child"
        context.report.warn(node.at, f"{fault}; child_to_parent is used", "unknown-choice")
    force, torque = (_axes(node, tag, None, context) for tag in ("force", "torque"))
    node.report_unread(context.report)
    return ForceTorque(frame=frame, parent_to_child=direction == "parent_to_child", force=force, torque=torque)


def _axes(imu: XmlNode, tag: str, shared: XmlNode | None, context: Context) -> tuple[Noise, Noise, Noise]:
    node = imu.find(tag)
    if node is None:
        noise = Noise() if shared is None else read_noise(shared, context)
        return noise, noise, noise
    x, y, z = (None if (axis := node.find(name)) is None else axis.find("noise") for name in "xyz")
    return read_noise(x, context), read_noise(y, context), read_noise(z, context)
