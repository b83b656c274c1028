"""Ambient light, background, sky and fog of a world, for the page's client."""

from trundle.robots.model import World

from .world.manifest import Fog, SceneSettings


def scene_settings(world: World) -> SceneSettings:
    """Return the settings of <scene> for a client."""
    scene, fog = world.scene, world.scene.fog
    return SceneSettings(
        ambient=scene.ambient[:3],
        background=scene.background[:3],
        sky=scene.sky,
        shadows=scene.shadows,
        grid=scene.grid,
        fog=None
        if fog.type == "none"
        else Fog(type=fog.type, color=fog.color[:3], start=fog.start_m, end=fog.end_m, density=fog.density),
    )
