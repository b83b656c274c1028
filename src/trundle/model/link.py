"""A rigid body with what is seen, touched and mounted on it."""

from typing import TYPE_CHECKING

from msgspec import Struct

from trundle.diagnostics import Source
from trundle.spatial import Pose

from .inertial import Inertial
from .material import GREY, Material
from .surface import Surface
from .visibility import EVERY_BIT

if TYPE_CHECKING:
    from .geometry import Geometry
    from .light import Light
    from .plugin import PluginTag
    from .sensor import Sensor


class Visual(Struct, frozen=True, kw_only=True):
    """A shape that is seen."""

    name: str
    geometry: "Geometry"
    at: Source
    link_from_visual: Pose = Pose()
    material: Material = GREY
    transparency: float = 0.0
    """0 opaque to 1 invisible."""
    cast_shadows: bool = True
    laser_retro: float = 0.0
    """What a laser gets back, as its intensity."""
    label: int = 0
    """What segmentation cameras see in it; 0: background."""
    visibility_flags: int = EVERY_BIT
    """Sensors see it whose mask shares a bit with them."""
    temperature: float | None = None
    """What thermal cameras see in it [K]; None: that of the air."""
    plugins: tuple["PluginTag", ...] = ()
    """Those that alter it or draw beside it; labels and temperatures are read."""


class Collision(Struct, frozen=True, kw_only=True):
    """A shape that is touched."""

    name: str
    geometry: "Geometry"
    at: Source
    link_from_collision: Pose = Pose()
    surface: Surface = Surface()
    laser_retro: float = 0.0
    """What a laser gets back, as its intensity."""


class Link(Struct, frozen=True, kw_only=True):
    """One rigid body of a model."""

    name: str
    at: Source
    model_from_link: Pose = Pose()
    """At rest, as written."""
    initial_pose: Pose | None = None
    """Where a saved state of the world has it, in the model frame; None: as written."""
    inertial: Inertial = Inertial()
    visuals: tuple[Visual, ...] = ()
    collisions: tuple[Collision, ...] = ()
    sensors: tuple["Sensor", ...] = ()
    gravity: bool = True
    self_collide: bool | None = None
    """None: as the model says."""
    kinematic: bool = False
    linear_decay: float = 0.0
    angular_decay: float = 0.0
    enable_wind: bool | None = None
    """None: as the model says."""
    lights: tuple["Light", ...] = ()
    fixed: bool = False
    """Held by the world: a link of a static model within one that is not."""
