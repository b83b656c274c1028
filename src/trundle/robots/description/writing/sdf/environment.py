"""Writer of lights, physics, scene, atmosphere and geographic position."""

from trundle.robots.model import Atmosphere, Fog, Light, SceneSettings, SphericalCoordinates, World
from trundle.spatial import ZERO

from ..tag import Tag

_SPHERICAL = ("surface_model", "world_frame_orientation", "latitude_deg", "longitude_deg", "elevation", "heading_deg")


def add_light(home: Tag, light: Light) -> None:
    """Append <light>."""
    tag = home.add("light", name=light.name, type=light.type)
    tag.add_pose(light.world_from_light)
    tag.add("diffuse", light.diffuse)
    tag.add("specular", light.specular)
    tag.add_unless("intensity", light.intensity, default=1.0)
    tag.add("direction", light.direction)
    tag.add("cast_shadows", light.cast_shadows)
    attenuation = tag.add("attenuation")
    attenuation.add("range", light.range_m)
    attenuation.add("constant", light.constant)
    attenuation.add("linear", light.linear)
    attenuation.add("quadratic", light.quadratic)
    if light.type == "spot" or light.outer_angle_rad:
        spot = tag.add("spot")
        spot.add("inner_angle", light.inner_angle_rad)
        spot.add("outer_angle", light.outer_angle_rad)
        spot.add("falloff", light.falloff)


def add_environment(home: Tag, world: World) -> None:
    """Append the settings of a world, without its models."""
    profiles = (world.physics, *world.other_physics)
    for physics in profiles:
        tag = home.add("physics", name=physics.name, type="ode")
        tag.add("max_step_size", physics.max_step_size_s)
        tag.add("real_time_factor", physics.real_time_factor)
        tag.add("real_time_update_rate", physics.real_time_update_rate_hz)
        if any(other.gravity != world.physics.gravity for other in profiles):
            tag.add("gravity", physics.gravity)
    home.add("gravity", world.physics.gravity)
    home.add("magnetic_field", world.magnetic_field)
    if world.wind != ZERO:
        home.add("wind").add("linear_velocity", world.wind)
    if world.atmosphere != Atmosphere():
        air = home.add("atmosphere", type="adiabatic")
        for name in ("temperature", "temperature_gradient", "pressure"):
            air.add(name, getattr(world.atmosphere, name))
    if world.spherical_coordinates != SphericalCoordinates():
        coordinates = home.add("spherical_coordinates")
        for name in _SPHERICAL:
            coordinates.add(name, getattr(world.spherical_coordinates, name))
    _add_scene(home.add("scene"), world.scene)


def _add_scene(tag: Tag, scene: SceneSettings) -> None:
    tag.add("ambient", scene.ambient)
    tag.add("background", scene.background)
    tag.add("shadows", scene.shadows)
    tag.add("grid", scene.grid)
    tag.add("origin_visual", scene.origin_visual)
    if scene.sky:
        tag.add("sky")
    if scene.fog != Fog():
        fog = tag.add("fog")
        fog.add("type", scene.fog.type)
        fog.add("color", scene.fog.color)
        fog.add("start", scene.fog.start_m)
        fog.add("end", scene.fog.end_m)
        fog.add("density", scene.fog.density)
