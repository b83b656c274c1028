"""World environment: physics settings, gravity, geographic origin, atmosphere and scene."""

from msgspec import Struct

from trundle.spatial import Vector3

from .material import Rgba


class PhysicsSettings(Struct, frozen=True, kw_only=True):
    """Time step, real-time rate and gravity."""

    name: str = "default_physics"
    """SDF's default."""
    max_step_size_s: float = 0.001
    real_time_factor: float = 1.0
    """As written; the update rate decides, as in Gazebo."""
    real_time_update_rate_hz: float = 1000.0
    """Steps per second of wall time that Gazebo aims at; 0: as fast as possible."""
    gravity: Vector3 = (0.0, 0.0, -9.8)
    """[m/s²] SDF's default, which is not 9.81."""


class SphericalCoordinates(Struct, frozen=True, kw_only=True):
    """Geographic position and heading of the world's origin."""

    latitude_deg: float = 0.0
    longitude_deg: float = 0.0
    elevation: float = 0.0
    """[m]"""
    heading_deg: float = 0.0
    """Angle from east to the world's x axis."""
    surface_model: str = "EARTH_WGS84"
    world_frame_orientation: str = "ENU"


class Atmosphere(Struct, frozen=True, kw_only=True):
    """Atmosphere with SDF's adiabatic temperature gradient."""

    temperature: float = 288.15
    """At the ground [K]."""
    pressure: float = 101325.0
    """At the ground [Pa]."""
    temperature_gradient: float = -0.0065
    """[K/m]"""


class Fog(Struct, frozen=True, kw_only=True):
    """Fog that fades distant surfaces."""

    type: str = "none"
    """none, linear, quadratic or exponential."""
    color: Rgba = (1.0, 1.0, 1.0, 1.0)
    start_m: float = 1.0
    end_m: float = 100.0
    density: float = 1.0


class SceneSettings(Struct, frozen=True, kw_only=True):
    """Scene defaults: ambient light, background, shadows, sky and fog."""

    ambient: Rgba = (0.4, 0.4, 0.4, 1.0)
    background: Rgba = (0.7, 0.7, 0.7, 1.0)
    """Gazebo's grey."""
    shadows: bool = True
    sky: bool = False
    grid: bool = True
    origin_visual: bool = True
    fog: Fog = Fog()
