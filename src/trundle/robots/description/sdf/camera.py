"""Reader of <camera>, for cameras of every kind."""

import math
from collections.abc import Mapping

from msgspec.structs import replace

from trundle.base.xmlnode import XmlNode
from trundle.robots.model import CameraOptics, Distortion, Lens, PixelIntrinsics, Projection

from .context import Context, read_bits, read_pose, warn_ignored
from .noise import read_noise

WIDE = frozenset({"wideanglecamera", "wide_angle_camera"})
CAMERA_TYPES = WIDE | {
    "camera",
    "multicamera",
    "depth",
    "depth_camera",
    "rgbd",
    "rgbd_camera",
    "segmentation",
    "segmentation_camera",
    "boundingbox",
    "boundingbox_camera",
    "thermal",
    "thermal_camera",
}
"""Sensor types with a <camera>."""
_MAX_SIDE_PX = 16384
_MAX_PX = 1 << 25
"""Maximum number of pixels of an image."""
_MIN_PINHOLE_RAD, _MAX_PINHOLE_RAD = 1e-6, 3.1
"""Limits of a pinhole's field of view."""
_MAX_CLIP_M = 1e30
_MAX_COEFFICIENT = 1e6
_FOCAL_RANGE_PX = (1e-3, 1e9)
_MAX_OFFSET_PX = 1e6
"""Maximum coordinates of the principal point, and maximum skew."""
_LENSES: Mapping[str, tuple[float, float, str]] = {
    "gnomonical": (1.0, 1.0, "tan"),
    "stereographic": (2.0, 2.0, "tan"),
    "equidistant": (1.0, 1.0, "id"),
    "equisolid_angle": (2.0, 2.0, "sin"),
    "orthographic": (1.0, 1.0, "sin"),
}
"""Type of a lens → c1, c2, fun."""


def read_cameras(sensor: XmlNode, type_: str, context: Context) -> tuple[CameraOptics, ...]:
    """Read a sensor's <camera>, or all of them for a multicamera."""
    nodes = sensor.all("camera")
    if not nodes:
        context.report.warn(
            sensor.at,
            f"sensor {sensor.attribute('name')!r} has no <camera>; SDF's default one is used",
            "incomplete-element",
        )
        return (_with_lens(CameraOptics(), None, type_, context),)
    if type_ == "multicamera":
        named: dict[str, CameraOptics] = {}
        for i, node in enumerate(nodes):
            name = node.attribute("name") or f"camera_{i}"
            if name in named:
                context.report.warn(node.at, f"a second camera {name!r}; it is renamed '{name}_{i}'", "duplicate-name")
                name = f"{name}_{i}"
            named[name] = replace(_read(node, type_, context), name=name)
        return tuple(named.values())
    return (_read(nodes[0], type_, context),)


def _read(node: XmlNode, type_: str, context: Context) -> CameraOptics:
    report = context.report
    default = CameraOptics()
    image, clip, depth = node.find("image"), node.find("clip"), node.find("depth_camera")
    depth_clip = None if depth is None else depth.find("clip")
    optics = CameraOptics(
        sensor_from_camera=read_pose(node, context).pose,
        horizontal_fov_rad=node.number("horizontal_fov", default=default.horizontal_fov_rad),
        width_px=default.width_px if image is None else image.integer("width", default=320),
        height_px=default.height_px if image is None else image.integer("height", default=240),
        format=default.format if image is None else image.string("format", default=default.format),
        near_m=default.near_m if clip is None else clip.number("near", default=default.near_m),
        far_m=default.far_m if clip is None else clip.number("far", default=default.far_m),
        noise=read_noise(node.find("noise"), context),
        distortion=_distortion(node.find("distortion"), context),
        save_path=_save_path(node.find("save"), context),
        panoptic=_one_of(node, "segmentation_type", ("semantic", "instance", "panoptic"), context) != "semantic",
        visibility_mask=read_bits(node, "visibility_mask"),
        triggered=node.flag("triggered", default=False),
        trigger_topic=node.string("trigger_topic"),
        info_topic=_child_source(node, "camera_info_topic"),
        optical_frame=_child_source(node, "optical_frame_id"),
        box_type=_box_type(node, context),
    )
    if depth_clip is not None:
        optics = replace(
            optics,
            depth_near_m=depth_clip.number("near", default=optics.near_m),
            depth_far_m=depth_clip.number("far", default=optics.far_m),
        )
    node.attribute("name")
    if image is not None:
        warn_ignored(image, ("anti_aliasing",), "sets the renderer's quality only", context)
    if depth is not None:
        warn_ignored(depth, ("output",), "has no effect: depths and points are both published", context)
    optics = _with_lens(_repaired(optics, node, type_, context), node.find("lens"), type_, context)
    for element in (node, image, clip, depth, depth_clip):
        if element is not None:
            element.report_unread(report)
    return optics


def _child_source(node: XmlNode, tag: str) -> str:
    word = node.string(tag)
    return "" if word == "__default__" else word


def _distortion(node: XmlNode | None, context: Context) -> Distortion:
    if node is None:
        return Distortion()
    report = context.report
    k1, k2, k3, p1, p2 = (node.number(tag, default=0.0) for tag in ("k1", "k2", "k3", "p1", "p2"))
    center = node.find("center")
    point = None if center is None else center.as_numbers(2)
    node.report_unread(report)
    if max(map(abs, (k1, k2, k3, p1, p2, *(point or ())))) > _MAX_COEFFICIENT:
        report.warn(
            node.at,
            f"coefficients and a center beyond {_MAX_COEFFICIENT:g} are not possible; no distortion is used",
            "out-of-range",
        )
        return Distortion()
    return Distortion(
        k1=k1,
        k2=k2,
        k3=k3,
        p1=p1,
        p2=p2,
        center=(0.5, 0.5) if point is None else (point[0], point[1]),
    )


def _save_path(node: XmlNode | None, context: Context) -> str | None:
    if node is None:
        return None
    enabled = (node.attribute("enabled") or "").lower() in ("true", "1")
    path = node.string("path")
    node.report_unread(context.report)
    return path if enabled and path not in ("", "__default__") else None


def _box_type(node: XmlNode, context: Context) -> str:
    names = {"2d": "2d", "visible_2d": "2d", "visible_box_2d": "2d", "full_2d": "full_2d", "full_box_2d": "full_2d"}
    names["3d"] = "3d"
    return names[_one_of(node, "box_type", tuple(names), context)]


def _one_of(node: XmlNode, tag: str, choices: tuple[str, ...], context: Context) -> str:
    """Return a child's text in lower case, or the first choice with a warning if it is none of them."""
    value = node.string(tag).lower() or choices[0]
    if value not in choices:
        context.report.warn(
            node.at, f"no {tag} {value!r}: {', '.join(choices)}; {choices[0]} is used", "unknown-choice"
        )
        return choices[0]
    return value


def _repaired(optics: CameraOptics, node: XmlNode, type_: str, context: Context) -> CameraOptics:
    """Replace impossible values by SDF's defaults, with a warning."""
    default, report = CameraOptics(), context.report
    width, height, fov = optics.width_px, optics.height_px, optics.horizontal_fov_rad
    if not (0 < width <= _MAX_SIDE_PX and 0 < height <= _MAX_SIDE_PX and width * height <= _MAX_PX):
        size = f"{default.width_px} x {default.height_px}"
        report.warn(node.at, f"a camera of {width} x {height} pixels is not possible; {size} is used", "out-of-range")
        optics = replace(optics, width_px=default.width_px, height_px=default.height_px)
    max_fov = math.tau + 1e-3 if type_ in WIDE else _MAX_PINHOLE_RAD
    if not _MIN_PINHOLE_RAD <= fov <= max_fov:
        default_fov = default.horizontal_fov_rad
        report.warn(node.at, f"horizontal_fov {fov:g} rad is not possible; {default_fov:g} is used", "out-of-range")
        optics = replace(optics, horizontal_fov_rad=default_fov)
    if not 1.0 / _MAX_CLIP_M <= optics.near_m < optics.far_m <= _MAX_CLIP_M:
        report.warn(
            node.at,
            f"clip near {optics.near_m:g}, far {optics.far_m:g} shows nothing; 0.1 and 100 are used",
            "out-of-range",
        )
        optics = replace(optics, near_m=default.near_m, far_m=default.far_m)
    near, far = optics.depth_near_m, optics.depth_far_m
    if near is not None and far is not None and not 0.0 <= near < far <= _MAX_CLIP_M:
        report.warn(
            node.at,
            f"depth clip near {near:g}, far {far:g} shows nothing; the camera's own clip is used",
            "out-of-range",
        )
        optics = replace(optics, depth_near_m=None, depth_far_m=None)
    return optics


def _with_lens(optics: CameraOptics, node: XmlNode | None, type_: str, context: Context) -> CameraOptics:
    if type_ in WIDE:
        optics = replace(optics, lens=_lens(node, context))
    if node is None:
        return optics
    if type_ in WIDE:
        warn_ignored(node, ("intrinsics",), "does not apply to wide-angle cameras", context)
    else:
        wide = ("type", "scale_to_hfov", "custom_function", "cutoff_angle", "env_texture_size")
        warn_ignored(node, wide, "is for wide-angle cameras", context)
        optics = replace(optics, intrinsics=_intrinsics(node.find("intrinsics"), context))
    optics = replace(optics, projection=_projection(node.find("projection"), context))
    node.report_unread(context.report)
    return optics


def _lens(node: XmlNode | None, context: Context) -> Lens:
    if node is None:
        c1, c2, fun = _LENSES["stereographic"]
        return Lens(c1=c1, c2=c2, fun=fun)
    report = context.report
    type_ = node.string("type").lower() or "stereographic"
    custom = node.find("custom_function")
    if type_ == "custom" and custom is not None:
        c1, c2, c3, f = (
            custom.number(tag, default=value) for tag, value in (("c1", 1.0), ("c2", 1.0), ("c3", 0.0), ("f", 1.0))
        )
        fun = custom.string("fun").lower() or "tan"
        custom.report_unread(report)
        is_lens = (
            all(1.0 / _MAX_COEFFICIENT <= abs(c) <= _MAX_COEFFICIENT for c in (c1, c2, f))
            and abs(c3) <= _MAX_COEFFICIENT
        )
        if fun not in ("tan", "sin", "id") or not is_lens:
            requirement = "a lens needs fun tan, sin or id, and c1, c2 and f neither 0 nor huge"
            report.warn(custom.at, f"{requirement}; tan is used alone", "out-of-range")
            c1, c2, c3, f, fun = 1.0, 1.0, 0.0, 1.0, "tan"
    elif type_ in _LENSES:
        (c1, c2, fun), c3, f = _LENSES[type_], 0.0, 1.0
    else:
        types = ", ".join([*_LENSES, "custom"])
        report.warn(node.at, f"no lens {type_!r}: {types}; stereographic is used", "unknown-choice")
        (c1, c2, fun), c3, f = _LENSES["stereographic"], 0.0, 1.0
    face = node.integer("env_texture_size", default=256)
    if not 16 <= face <= 4096:
        report.warn(node.at, f"env_texture_size {face} is not possible; 256 is used", "out-of-range")
        face = 256
    return Lens(
        c1=c1,
        c2=c2,
        c3=c3,
        f=f,
        fun=fun,
        scale_to_hfov=node.flag("scale_to_hfov", default=True),
        cutoff_rad=node.number("cutoff_angle", default=1.5707),
        face_px=face,
    )


def _intrinsics(node: XmlNode | None, context: Context) -> PixelIntrinsics | None:
    if node is None:
        return None
    report = context.report
    fx, fy, cx, cy, skew = (
        node.number(tag, default=value)
        for tag, value in (("fx", 277.0), ("fy", 277.0), ("cx", 160.0), ("cy", 120.0), ("s", 0.0))
    )
    node.report_unread(report)
    shortest, longest = _FOCAL_RANGE_PX
    if not (shortest <= fx <= longest and shortest <= fy <= longest):
        report.warn(
            node.at,
            f"focal lengths of {fx:g} and {fy:g} pixels are not possible; horizontal_fov is used",
            "out-of-range",
        )
        return None
    if max(abs(cx), abs(cy), abs(skew)) > _MAX_OFFSET_PX:
        report.warn(
            node.at, f"cx {cx:g}, cy {cy:g}, s {skew:g} pixels show nothing; horizontal_fov is used", "out-of-range"
        )
        return None
    return PixelIntrinsics(fx=fx, fy=fy, cx=cx, cy=cy, skew=skew)


def _projection(node: XmlNode | None, context: Context) -> Projection | None:
    if node is None:
        return None
    report = context.report
    fx, fy, cx, cy, tx, ty = (
        node.number(tag, default=value)
        for tag, value in (("p_fx", 277.0), ("p_fy", 277.0), ("p_cx", 160.0), ("p_cy", 120.0), ("tx", 0.0), ("ty", 0.0))
    )
    node.report_unread(report)
    return Projection(fx=fx, fy=fy, cx=cx, cy=cy, tx=tx, ty=ty)
