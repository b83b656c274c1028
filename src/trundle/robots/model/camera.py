"""Camera parameters: image, lens, distortion, clip planes and noise."""

from msgspec import Struct

from trundle.spatial import Pose

from .noise import Noise
from .visibility import EVERY_BIT


class Distortion(Struct, frozen=True, kw_only=True):
    """Brown distortion of normalised image coordinates, as in OpenCV's plumb_bob."""

    __module__ = "trundle"

    k1: float = 0.0
    """Radial coefficient of r²."""
    k2: float = 0.0
    """Radial coefficient of r⁴."""
    k3: float = 0.0
    """Radial coefficient of r⁶."""
    p1: float = 0.0
    """First tangential coefficient."""
    p2: float = 0.0
    """Second tangential coefficient."""
    center: tuple[float, float] = (0.5, 0.5)
    """Centre of distortion from the upper left corner [widths, heights of the image]."""


class PixelIntrinsics(Struct, frozen=True, kw_only=True):
    """Pinhole intrinsics in pixels: u = fx x + s y + cx, v = fy y + cy, for a ray through (x, y, 1)."""

    __module__ = "trundle"

    fx: float
    """Focal length along the rows [px]."""
    fy: float
    """Focal length along the columns [px]."""
    cx: float
    """Column of the principal point [px]."""
    cy: float
    """Row of the principal point [px]."""
    skew: float = 0.0
    """Skew s of the axes [px]."""


class Projection(Struct, frozen=True, kw_only=True):
    """Projection matrix P (3×4) of camera_info."""

    __module__ = "trundle"

    fx: float
    """Element (0, 0) of P [px]."""
    fy: float
    """Element (1, 1) of P [px]."""
    cx: float
    """Element (0, 2) of P [px]."""
    cy: float
    """Element (1, 2) of P [px]."""
    tx: float = 0.0
    """Element (0, 3) of P [px·m]; of the second camera of a stereo pair −fx times the baseline."""
    ty: float = 0.0
    """Element (1, 3) of P [px·m]."""


class Lens(Struct, frozen=True, kw_only=True):
    """Wide-angle lens: a ray at angle θ from the axis falls at radius r = c1 f fun(θ / c2 + c3) from the image centre,
    in units of half the image width.
    """

    __module__ = "trundle"

    c1: float
    """Radial scale c1."""
    c2: float
    """Angular scale c2, a divisor."""
    c3: float = 0.0
    """Offset of the angle [rad]."""
    f: float = 1.0
    """Radial scale f; `scale_to_hfov` sets it."""
    fun: str = "tan"
    """tan, sin or id."""
    scale_to_hfov: bool = True
    """Scale f so that the image width spans the horizontal field of view."""
    cutoff_rad: float = 1.5707
    """Largest angle from the axis [rad]; rays beyond it are black."""
    face_px: int = 256
    """Width of each pinhole face image that the lens samples [px]."""


class CameraOptics(Struct, frozen=True, kw_only=True):
    """Camera looking along +x of its frame, y to the left, z up."""

    __module__ = "trundle"

    name: str = ""
    """Name of the camera within a multicamera."""
    sensor_from_camera: Pose = Pose()
    """Pose in the sensor's frame."""
    horizontal_fov_rad: float = 1.047
    """Horizontal field of view [rad]."""
    width_px: int = 320
    """Width of the image [px]."""
    height_px: int = 240
    """Height of the image [px]."""
    format: str = "R8G8B8"
    """Pixels, by Gazebo's names: R8G8B8, B8G8R8, L8, …"""
    near_m: float = 0.1
    """Near clip plane [m]."""
    far_m: float = 100.0
    """Far clip plane [m]."""
    noise: Noise = Noise()
    """Noise per pixel, white = 1; [m] for a depth image."""
    distortion: Distortion = Distortion()
    """Distortion of the image by the lens."""
    intrinsics: PixelIntrinsics | None = None
    """None: centred principal point, focal length from the horizontal field of view."""
    projection: Projection | None = None
    """None: that of the intrinsics."""
    lens: Lens | None = None
    """Set for wide-angle cameras."""
    depth_near_m: float | None = None
    """Near limit of depths [m]; None: the near clip plane."""
    depth_far_m: float | None = None
    """Far limit of depths [m]; None: the far clip plane."""
    save_path: str | None = None
    """Folder that images are saved to."""
    panoptic: bool = False
    """True if a segmentation camera distinguishes instances of one label."""
    visibility_mask: int = EVERY_BIT
    """Mask of the visuals drawn: those whose flags share a bit with it."""
    triggered: bool = False
    """True if an image is taken only on a trigger message."""
    trigger_topic: str = ""
    """Topic of trigger messages; empty: `trigger` below the sensor's own topic."""
    info_topic: str = ""
    """Topic of camera_info; empty: the default."""
    optical_frame: str = ""
    """frame_id of the images; empty: the default."""
    box_type: str = "2d"
    """Bounding box type: 2d encloses the visible part, full_2d the whole object, 3d is a box in space."""
