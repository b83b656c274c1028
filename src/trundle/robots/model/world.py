"""World: the result of every reader and the input of every consumer."""

from typing import TYPE_CHECKING

from msgspec import Struct

from trundle.base.diagnostics import Source
from trundle.spatial import ZERO, Vector3

from .environment import Atmosphere, PhysicsSettings, SceneSettings, SphericalCoordinates

if TYPE_CHECKING:
    from .actor import Actor
    from .joint import Joint
    from .kinematic_model import Frame, Model
    from .light import Light
    from .plugin import PluginTag
    from .road import Road


class World(Struct, frozen=True, kw_only=True):
    """Everything simulated together: models, lights, actors, plugins and settings."""

    name: str
    at: Source
    models: tuple["Model", ...] = ()
    joints: tuple["Joint", ...] = ()
    """Joints between models; links by `model::link`, poses and axes in the world frame."""
    frames: tuple["Frame", ...] = ()
    lights: tuple["Light", ...] = ()
    roads: tuple["Road", ...] = ()
    actors: tuple["Actor", ...] = ()
    plugins: tuple["PluginTag", ...] = ()
    physics: PhysicsSettings = PhysicsSettings()
    other_physics: tuple[PhysicsSettings, ...] = ()
    """Profiles that a plugin in C++ may choose."""
    scene: SceneSettings = SceneSettings()
    spherical_coordinates: SphericalCoordinates = SphericalCoordinates()
    atmosphere: Atmosphere = Atmosphere()
    magnetic_field: Vector3 = (5.5645e-6, 22.8758e-6, -42.3884e-6)
    """[T]"""
    wind: Vector3 = ZERO
    """[m/s]"""
    sdf_version: str | None = None
    """As written in the file; None for a URDF."""
