"""Readers of the world environment: <physics>, <scene>, atmosphere, geographic position and wind."""

from collections.abc import Mapping

from msgspec.structs import replace

from trundle.base.xmlnode import XmlNode
from trundle.robots.model import Atmosphere, Fog, PhysicsSettings, Rgba, SceneSettings, SphericalCoordinates
from trundle.spatial import Vector3

from .context import Context, warn_ignored
from .material import read_color

_MIN_TEMPERATURE, _MAX_TEMPERATURE = 1.0, 1e6
"""Bounds of the air temperature at the ground [K]."""
_MAX_ELEVATION_M = 1e9
_MAX_PRESSURE = 1e15
"""Bounds of the air pressure at the ground [Pa]."""
_AMBIENT: Mapping[tuple[int, int], Rgba] = {(1, 3): (0.0, 0.0, 0.0, 1.0), (1, 4): (0.2, 0.2, 0.2, 1.0)}
"""Version → default of the ambient light in the versions before it; from 1.4 on, it is 0.4."""


def read_physics(world: XmlNode, context: Context) -> list[PhysicsSettings]:
    """Read the <physics> profiles, first the default one, which is the first if none is marked."""
    profiles = world.all("physics")
    gravity = world.vector("gravity", default=PhysicsSettings().gravity)
    if not profiles:
        return [PhysicsSettings(gravity=gravity)]
    node = next((p for p in profiles if (p.attribute("default") or "") in ("1", "true")), profiles[0])
    others = [other for other in profiles if other is not node]
    for other in others:
        context.report.info(
            other.at,
            f"physics profile {other.attribute('name')!r} is not the default one; only plugins in C++ switch to it",
            "physics-profile",
        )
    return [_read_profile(profile, gravity, context) for profile in (node, *others)]


def _read_profile(node: XmlNode, gravity: Vector3, context: Context) -> PhysicsSettings:
    report = context.report
    default = PhysicsSettings()
    step = _step(node, context)
    if not 1e-6 <= step <= 1.0:
        report.warn(
            node.at, f"a step of {step:g} s is not possible; {default.max_step_size_s:g} is used", "out-of-range"
        )
        step = default.max_step_size_s
    rate_tag = "update_rate" if context.version < (1, 4) else "real_time_update_rate"
    rate = node.number(rate_tag, default=default.real_time_update_rate_hz)
    factor = node.number("real_time_factor", default=1.0)
    warn_ignored(
        node,
        ("max_contacts", "ode", "bullet", "simbody", "dart"),
        "is for Gazebo's engines; the engine here is MuJoCo",
        context,
    )
    if (node.attribute("type") or "ode") != "ode":
        report.info(node.at, f"physics of type {node.attribute('type')!r}: the engine here is MuJoCo", "physics-engine")
    node.attributes()
    gravity = node.vector("gravity", default=gravity)
    node.report_unread(report)
    return PhysicsSettings(
        name=node.attribute("name") or default.name,
        max_step_size_s=step,
        real_time_factor=factor,
        real_time_update_rate_hz=max(rate, 0.0),
        gravity=gravity,
    )


def _step(node: XmlNode, context: Context) -> float:
    """Return the time step [s], which before SDF 1.4 was part of the engine's settings."""
    default = PhysicsSettings().max_step_size_s
    if context.version < (1, 4) and node.find("max_step_size") is None:
        ode, bullet = node.find("ode"), node.find("bullet")
        solver = None if ode is None else ode.find("solver")
        for engine in (solver, bullet):
            if engine is not None and engine.find("dt") is not None:
                return engine.number("dt", default=default)
    return node.number("max_step_size", default=default)


def read_scene(world: XmlNode, context: Context) -> SceneSettings:
    """Read <scene>."""
    node = world.find("scene")
    report = context.report
    ambient = next((rgba for before, rgba in _AMBIENT.items() if context.version < before), SceneSettings().ambient)
    if node is None:
        return SceneSettings(ambient=ambient)
    default = SceneSettings()
    scene = SceneSettings(
        ambient=read_color(node, "ambient", ambient, context),
        background=read_color(node, "background", default.background, context),
        shadows=node.flag("shadows", default=True),
        sky=_has_sky(node, context),
        grid=node.flag("grid", default=True),
        origin_visual=node.flag("origin_visual", default=True),
        fog=_fog(node, context),
    )
    node.report_unread(report)
    return scene


def _has_sky(scene: XmlNode, context: Context) -> bool:
    node = scene.find("sky")
    if node is None:
        return False
    warn_ignored(node, ("time", "sunrise", "sunset", "clouds", "cubemap_uri"), "is not drawn", context)
    node.report_unread(context.report)
    return True


def _fog(scene: XmlNode, context: Context) -> Fog:
    node = scene.find("fog")
    if node is None:
        return Fog()
    report, default = context.report, Fog()
    fog = Fog(
        type=node.string("type") or default.type,
        color=read_color(node, "color", default.color, context),
        start_m=node.number("start", default=default.start_m),
        end_m=node.number("end", default=default.end_m),
        density=node.number("density", default=default.density),
    )
    node.report_unread(report)
    return fog


def read_spherical_coordinates(world: XmlNode, context: Context) -> SphericalCoordinates:
    """Read <spherical_coordinates>."""
    node = world.find("spherical_coordinates")
    if node is None:
        return SphericalCoordinates()
    report, default = context.report, SphericalCoordinates()
    coordinates = SphericalCoordinates(
        latitude_deg=node.number("latitude_deg", default=0.0),
        longitude_deg=node.number("longitude_deg", default=0.0),
        elevation=node.number("elevation", default=0.0),
        heading_deg=node.number("heading_deg", default=0.0),
        surface_model=node.string("surface_model") or default.surface_model,
        world_frame_orientation=node.string("world_frame_orientation") or default.world_frame_orientation,
    )
    if abs(coordinates.elevation) > _MAX_ELEVATION_M:
        report.warn(node.at, f"an elevation of {coordinates.elevation:g} m is not possible; 0 is used", "out-of-range")
        coordinates = replace(coordinates, elevation=0.0)
    node.report_unread(report)
    return coordinates


def read_atmosphere(world: XmlNode, context: Context) -> Atmosphere:
    """Read <atmosphere>."""
    node = world.find("atmosphere")
    if node is None:
        return Atmosphere()
    report, default, default_type = context.report, Atmosphere(), "adiabatic"
    if (node.attribute("type") or default_type) != default_type:
        report.warn(node.at, f"no atmosphere type {node.attribute('type')!r}; {default_type} is used", "unknown-choice")
    air = Atmosphere(
        temperature=node.number("temperature", default=default.temperature),
        pressure=node.number("pressure", default=default.pressure),
        temperature_gradient=node.number("temperature_gradient", default=default.temperature_gradient),
    )
    node.report_unread(report)
    if not _MIN_TEMPERATURE <= air.temperature <= _MAX_TEMPERATURE or not 0.0 < air.pressure <= _MAX_PRESSURE:
        fault = f"air of {air.temperature:g} K and {air.pressure:g} Pa is not possible"
        report.warn(node.at, f"{fault}; {default.temperature:g} K and {default.pressure:g} Pa are used", "out-of-range")
        return default
    return air
