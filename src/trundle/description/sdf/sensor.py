"""Reads <sensor>; what is simulated in full, the others by name and type."""

from trundle.diagnostics import Diagnostics
from trundle.model import CameraOptics, PluginTag, Sensor
from trundle.xmlnode import XmlNode

from .context import Context, read_pose
from .frames import FrameGraph
from .measuring import RANGING, read_force_torque, read_gps, read_imu, read_scan, read_touching

WHOLE = RANGING | {"camera", "imu", "gps", "navsat", "contact", "force_torque"}
"""Types whose every setting is read."""


def read_sensor(node: XmlNode, owner: str, graph: FrameGraph, context: Context) -> Sensor:
    """Read one sensor, placed in its owner's frame: a link's or a joint's."""
    report = context.report
    type_ = node.attribute("type") or "none"
    camera = node.find("camera")
    sensor = Sensor(
        name=node.attribute("name") or type_,
        type=type_,
        at=node.at,
        link_from_sensor=graph.within(owner, read_pose(node, context), node.at),
        update_rate_hz=max(0.0, node.number("update_rate", default=0.0, report=report)),
        always_on=node.flag("always_on", default=False, report=report),
        visualize=node.flag("visualize", default=False, report=report),
        topic=node.string("topic"),
        camera=_optics(camera, context) if camera is not None and type_ == "camera" else None,
        scan=read_scan(node, context) if type_ in RANGING else None,
        imu=read_imu(node, context) if type_ == "imu" else None,
        gps=read_gps(node, context) if type_ in ("gps", "navsat") else None,
        force_torque=read_force_torque(node, context) if type_ == "force_torque" else None,
        touching=read_touching(node, context) if type_ == "contact" else None,
        plugins=tuple(read_plugin(tag) for tag in node.all("plugin")),
    )
    if sensor.type in WHOLE:
        node.report_unread(report)
    return sensor


def _optics(node: XmlNode, context: Context) -> CameraOptics:
    report = context.report
    default = CameraOptics()
    image, clip = node.find("image"), node.find("clip")
    optics = CameraOptics(
        sensor_from_camera=read_pose(node, context).pose,
        horizontal_fov_rad=node.number("horizontal_fov", default=default.horizontal_fov_rad, report=report),
        width_px=default.width_px if image is None else image.integer("width", default=320, report=report),
        height_px=default.height_px if image is None else image.integer("height", default=240, report=report),
        format=default.format if image is None else image.string("format", default=default.format),
        near_m=default.near_m if clip is None else clip.number("near", default=default.near_m, report=report),
        far_m=default.far_m if clip is None else clip.number("far", default=default.far_m, report=report),
    )
    for each in (node, image, clip):
        if each is not None:
            each.report_unread(report)
    return _mended(optics, node, report)


_LARGEST_PX = 16384


def _mended(optics: CameraOptics, node: XmlNode, report: Diagnostics) -> CameraOptics:
    """A camera that can make no picture becomes SDF's default one, aloud."""
    default = CameraOptics()
    size_is_sound = 0 < optics.width_px <= _LARGEST_PX and 0 < optics.height_px <= _LARGEST_PX
    if not size_is_sound:
        size = f"{optics.width_px} x {optics.height_px}"
        report.warn(
            node.at, f"a camera of {size} pixels is not possible; {default.width_px} x {default.height_px} is used"
        )
    fov_is_sound = 0.0 < optics.horizontal_fov_rad < 3.1
    if not fov_is_sound:
        report.warn(
            node.at,
            f"horizontal_fov {optics.horizontal_fov_rad:g} rad is not possible; {default.horizontal_fov_rad:g} is used",
        )
    clip_is_sound = 0.0 < optics.near_m < optics.far_m
    if not clip_is_sound:
        report.warn(node.at, f"clip near {optics.near_m:g}, far {optics.far_m:g} shows nothing; 0.1 and 100 are used")
    return CameraOptics(
        sensor_from_camera=optics.sensor_from_camera,
        horizontal_fov_rad=optics.horizontal_fov_rad if fov_is_sound else default.horizontal_fov_rad,
        width_px=optics.width_px if size_is_sound else default.width_px,
        height_px=optics.height_px if size_is_sound else default.height_px,
        format=optics.format,
        near_m=optics.near_m if clip_is_sound else default.near_m,
        far_m=optics.far_m if clip_is_sound else default.far_m,
    )


def read_plugin(node: XmlNode) -> PluginTag:
    """Keep a <plugin> as its author wrote it."""
    return PluginTag(
        name=node.attribute("name") or "", filename=node.attribute("filename") or "", at=node.at, node=node
    )
