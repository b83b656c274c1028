"""What a camera is made of: picture, lens, distortion, clip and noise."""

from msgspec import Struct

from trundle.spatial import Pose

from .noise import Noise
from .visibility import EVERY_BIT


class Distortion(Struct, frozen=True, kw_only=True):
    """Brown's distortion of normalised image coordinates, as OpenCV's plumb_bob has it."""

    k1: float = 0.0
    k2: float = 0.0
    k3: float = 0.0
    p1: float = 0.0
    p2: float = 0.0
    center: tuple[float, float] = (0.5, 0.5)
    """Of the distortion, in widths and heights from the upper left corner."""


class PixelIntrinsics(Struct, frozen=True, kw_only=True):
    """A pinhole in pixels: u = fx x + s y + cx, v = fy y + cy, for a ray through (x, y, 1)."""

    fx: float
    fy: float
    cx: float
    cy: float
    skew: float = 0.0


class Projection(Struct, frozen=True, kw_only=True):
    """The 3×4 matrix P that camera_info is to tell."""

    fx: float
    fy: float
    cx: float
    cy: float
    tx: float = 0.0
    ty: float = 0.0


class Lens(Struct, frozen=True, kw_only=True):
    """A wide lens: a ray at an angle θ from the axis is seen r = c1 f fun(θ / c2 + c3) from the middle, where half the
    picture's width is 1."""

    c1: float
    c2: float
    c3: float = 0.0
    f: float = 1.0
    fun: str = "tan"
    """tan, sin or id."""
    scale_to_hfov: bool = True
    """f is such that the picture's width holds the horizontal field of view."""
    cutoff_rad: float = 1.5707
    """What is farther from the axis is black."""
    face_px: int = 256
    """Width of each of the pinhole pictures that the lens looks at."""


class CameraOptics(Struct, frozen=True, kw_only=True):
    """A camera looking along +x of its frame, y to the left, z up."""

    name: str = ""
    """Tells the cameras of a multicamera apart."""
    sensor_from_camera: Pose = Pose()
    horizontal_fov_rad: float = 1.047
    width_px: int = 320
    height_px: int = 240
    format: str = "R8G8B8"
    near_m: float = 0.1
    far_m: float = 100.0
    noise: Noise = Noise()
    """Of each pixel, where white is 1; of a depth picture [m]."""
    distortion: Distortion = Distortion()
    intrinsics: PixelIntrinsics | None = None
    """None: the picture's middle is straight ahead, and its width holds the horizontal field of view."""
    projection: Projection | None = None
    lens: Lens | None = None
    """Set for wide-angle cameras."""
    depth_near_m: float | None = None
    """Where depths begin; None: where the picture does."""
    depth_far_m: float | None = None
    save_path: str | None = None
    """The folder that pictures are saved to."""
    panoptic: bool = False
    """A segmentation camera tells things of one label apart."""
    visibility_mask: int = EVERY_BIT
    """Visuals are seen whose flags share a bit with it."""
    triggered: bool = False
    """It takes a picture only when it is told to."""
    trigger_topic: str = ""
    """Where it is told so; empty: `trigger` below its own."""
    info_topic: str = ""
    """Of camera_info, where that is elsewhere."""
    optical_frame: str = ""
    """The frame that its pictures are in, where that has a name."""
    box_type: str = "2d"
    """Of a bounding box camera: 2d is around what is visible, full_2d around all of a thing, 3d in space."""
