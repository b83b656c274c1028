"""Ambient light, background, sky and fog of a world, as the page's client reads them."""

from trundle.robots.model import World


def scene_settings(world: World) -> dict[str, object]:
    """Return the entry `scene` of the manifest: docs/decisions/0020."""
    scene, fog = world.scene, world.scene.fog
    return {
        "ambient": scene.ambient[:3],
        "background": scene.background[:3],
        "sky": scene.sky,
        "shadows": scene.shadows,
        "grid": scene.grid,
        "fog": None
        if fog.type == "none"
        else {
            "type": fog.type,
            "color": fog.colour[:3],
            "start": fog.start_m,
            "end": fog.end_m,
            "density": fog.density,
        },
    }
