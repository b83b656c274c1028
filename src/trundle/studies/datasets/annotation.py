"""Annotations of a picture, independent of any format.

Pixels are counted from the picture's upper left corner: the first pixel spans 0 to 1, its centre is 0.5.
Cameras have optical frames: x to the right, y down, z along the view.
"""

from msgspec import Struct, field

Numbers = tuple[float, ...]


class Box2d(Struct, frozen=True, array_like=True):
    """Box along the picture's axes [px]."""

    left: float
    top: float
    right: float
    bottom: float

    @property
    def width(self) -> float:
        """[px]"""
        return self.right - self.left

    @property
    def height(self) -> float:
        """[px]"""
        return self.bottom - self.top


class Box3d(Struct, frozen=True, kw_only=True):
    """Box along a model's axes."""

    world_from_box: Numbers
    """x y z [m] of the centre, qw qx qy qz."""
    size: Numbers
    """Lengths along the box's axes [m]."""


class KeyPointAnnotation(Struct, frozen=True, kw_only=True):
    """Point of a model."""

    name: str
    world: Numbers
    """[m]"""
    pixel: Numbers | None
    """Pixel; None: the point is behind the camera or outside the picture."""
    is_visible: bool
    """True if nothing hides the point, not even its own model."""


class Mask(Struct, frozen=True, kw_only=True):
    """Mask in COCO's compressed run-length encoding, column by column."""

    size: tuple[int, int]
    """Height and width [px]."""
    counts: str


class ObjectAnnotation(Struct, frozen=True, kw_only=True):
    """Visible object."""

    instance: int
    """Number of the object in the segmentation."""
    model: str
    category: str
    world_from_model: Numbers
    """x y z [m], qw qx qy qz."""
    box: Box2d
    """Bounding box of the visible pixels."""
    amodal_box: Box2d
    """Bounding box of the whole object, including hidden parts, clipped to the picture."""
    box_3d: Box3d
    pixels: int
    """Number of visible pixels."""
    occlusion: float
    """Fraction that other objects hide, of the object's part within the picture."""
    truncation: float
    """Fraction of the object that is outside the picture."""
    mask: Mask
    key_points: tuple[KeyPointAnnotation, ...] = ()


class CameraAnnotation(Struct, frozen=True, kw_only=True):
    """Pinhole camera without distortion."""

    fx: float
    fy: float
    cx: float
    cy: float
    """Focal lengths and principal point [px]."""
    world_from_camera: Numbers
    """x y z [m], qw qx qy qz of the optical frame."""


class PictureAnnotation(Struct, frozen=True, kw_only=True):
    """Annotations of a picture."""

    number: int
    width: int
    height: int
    camera: CameraAnnotation
    camera_from_lidar: Numbers | None = None
    """x y z [m], qw qx qy qz in the optical frame."""
    objects: tuple[ObjectAnnotation, ...] = field(default_factory=tuple)
