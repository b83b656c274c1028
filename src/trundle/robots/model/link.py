"""Links: rigid bodies with visuals, collisions, sensors and lights."""

from typing import TYPE_CHECKING

from msgspec import Struct

from trundle.base.diagnostics import Source
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
    """Visual shape of a link."""

    name: str
    geometry: "Geometry"
    at: Source
    link_from_visual: Pose = Pose()
    material: Material = GREY
    transparency: float = 0.0
    """0 opaque to 1 invisible."""
    cast_shadows: bool = True
    laser_retro: float = 0.0
    """Intensity of a laser's return."""
    label: int = 0
    """Label for segmentation cameras; 0: background."""
    visibility_flags: int = EVERY_BIT
    """Visibility flags: drawn by sensors whose mask shares a bit with them."""
    temperature: float | None = None
    """Temperature for thermal cameras [K]; None: the ambient air's."""
    plugins: tuple["PluginTag", ...] = ()
    """Visual plugins; the reader has already taken labels and temperatures from them."""


class Collision(Struct, frozen=True, kw_only=True):
    """Collision shape of a link."""

    name: str
    geometry: "Geometry"
    at: Source
    link_from_collision: Pose = Pose()
    surface: Surface = Surface()
    laser_retro: float = 0.0
    """Intensity of a laser's return."""
    max_contacts: int = 10
    """Largest number of ODE's contacts with another collision, as written; MuJoCo creates as many as needed."""


class Link(Struct, frozen=True, kw_only=True):
    """Rigid body of a model."""

    name: str
    at: Source
    model_from_link: Pose = Pose()
    """Pose with every joint at zero, as written."""
    initial_pose: Pose | None = None
    """Pose from a saved world state, in the model frame; None: as written."""
    inertial: Inertial = Inertial()
    visuals: tuple[Visual, ...] = ()
    collisions: tuple[Collision, ...] = ()
    sensors: tuple["Sensor", ...] = ()
    gravity: bool = True
    self_collide: bool | None = None
    """None: as the model."""
    kinematic: bool = False
    linear_decay: float = 0.0
    angular_decay: float = 0.0
    enable_wind: bool | None = None
    """None: as the model."""
    lights: tuple["Light", ...] = ()
    fixed: bool = False
    """True if fixed to the world: a link of a static model nested in a dynamic one."""
