"""Plan of a dataset."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal, TypeAlias

from trundle.base.diagnostics import Source
from trundle.robots.meshes import Texture
from trundle.spatial import Vector3

from .quantity import Quantity, constant

Format: TypeAlias = Literal["coco", "yolo", "kitti", "semantic_kitti", "mcap", "parquet"]
Numbers: TypeAlias = tuple[Quantity, Quantity, Quantity]


@dataclass(frozen=True, slots=True, kw_only=True)
class Color:
    """Random color."""

    choices: tuple[Vector3, ...] = ()
    """Red, green, blue, each 0 to 1; empty: hue, saturation and value."""
    hsv: Numbers = (constant(0.0), constant(0.0), constant(0.5))
    """Hue, saturation and value, each 0 to 1."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Paint:
    """Look of a model."""

    at: Source
    color: Color | None = None
    """Color of all its visuals; None: as written."""
    textures: tuple[Texture, ...] = ()
    """Images to choose from; empty: as written."""
    repeat: Quantity = constant(1.0)
    """Repetitions of the image along each axis."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Placement:
    """Random pose."""

    at: Source
    surface: str | None = None
    """Model on whose upper surface to place it; None: at `position`."""
    within: tuple[tuple[float, float], tuple[float, float]] | None = None
    """x and y of two opposite corners, in the world [m]; None: the extent of the surface."""
    position: Numbers | None = None
    """Position in the world [m]; without position and surface the model is not moved."""
    rotation: Literal["upright", "any"] | Numbers = "upright"
    """upright: about z only; any: uniform over all rotations; or roll, pitch, yaw [rad]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class KeyPoint:
    """Named point of a model."""

    name: str
    at: Source
    link: str | None
    """Link of the point; None: the model's frame."""
    point: Vector3
    """[m]"""


@dataclass(frozen=True, slots=True, kw_only=True)
class ObjectPlan:
    """Model to annotate."""

    name: str
    at: Source
    model: str | None = None
    """File or model://…; None: the model of this name in the world."""
    category: str
    count: Quantity
    """Number of instances in a picture."""
    placement: Placement
    paint: Paint
    joints: Mapping[str, Quantity] | Literal["any"] = field(default_factory=dict[str, Quantity])
    """Joint → position [rad or m]; "any": all joints anywhere between their limits."""
    key_points: tuple[KeyPoint, ...] = ()


@dataclass(frozen=True, slots=True, kw_only=True)
class DistractorPlan:
    """Simple shapes without annotation, for occlusion and variety."""

    at: Source
    count: Quantity
    size: Quantity
    """Lengths along each axis [m]."""
    placement: Placement
    paint: Paint


@dataclass(frozen=True, slots=True, kw_only=True)
class Orbit:
    """Camera positions about a point."""

    center: Vector3
    distance: Quantity
    """[m]"""
    azimuth: Quantity
    elevation: Quantity
    """Angle above the horizon [rad]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class CameraPlan:
    """Random camera."""

    at: Source
    viewpoint: Orbit | Numbers | str
    """Orbit; x, y, z in the world [m]; or a camera in the world, MODEL/SENSOR."""
    look_at: Numbers | str | None
    """Point in the world [m], or the name of an object; None: the centre of all objects."""
    roll: Quantity
    """[rad]"""
    horizontal_fov: Quantity
    """[rad]"""
    near_m: float
    far_m: float
    noise: float
    """Standard deviation of the color noise; 1 is the difference between black and white."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LightPlan:
    """Random light: one of the world, or an additional one."""

    name: str
    at: Source
    kind: Literal["directional", "point"] | None
    """None: a light of the world."""
    intensity: Quantity
    color: Color | None
    azimuth: Quantity
    elevation: Quantity | None
    """Elevation of a directional light's source [rad]; None: as written."""
    position: Numbers | None
    """Position of a point light in the world [m]."""
    shadows: bool | None
    """None: as written; an additional light casts shadows."""


@dataclass(frozen=True, slots=True, kw_only=True)
class LidarPlan:
    """Lidar that moves with the camera."""

    at: Source
    beams: int
    columns: int
    vertical: tuple[float, float]
    horizontal: tuple[float, float]
    """First and last angle [rad]."""
    range_m: float
    camera_from_lidar: tuple[float, ...]
    """x, y, z [m], roll, pitch, yaw [rad], in the camera's frame: x ahead, y to the left, z up."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DatasetPlan:
    """World, random parameters of its pictures, and output formats."""

    file: str
    """Plan's name in messages."""
    folder: Path
    """Base of relative paths."""
    text: str
    world: str
    world_at: Source
    count: int
    """Number of pictures."""
    seed: int
    width_px: int
    height_px: int
    samples: int
    """Samples per pixel and axis, for antialiasing."""
    formats: tuple[Format, ...]
    camera: CameraPlan
    objects: tuple[ObjectPlan, ...]
    distractors: DistractorPlan | None
    materials: Mapping[str, Paint]
    """Model of the world → look."""
    lights: tuple[LightPlan, ...]
    ambient: Quantity | None
    """Grey level; None: as written."""
    background: Color | None
    lidar: LidarPlan | None
    apart: bool
    """True to place models without overlaps."""
    settle_s: float
    """Simulated time after placing, in which models fall and come to rest."""

    @property
    def categories(self) -> tuple[str, ...]:
        """Categories in the order of the plan, numbered from 1."""
        return tuple(dict.fromkeys(object_plan.category for object_plan in self.objects))
