"""Light, sky and ground lines: how the page looks before anything stands in it."""

import numpy as np
import viser
from numpy.typing import NDArray

from trundle.render import Scene
from trundle.spatial import Vector3

_SUN_DIRECTION: Vector3 = (-0.5, 0.1, -0.9)
"""Gazebo's own sun."""
_SKY_ROWS_PX = 256
_GRID_LIFT_M = 0.003
"""Keeps the grid's lines out of the ground plane they would flicker in."""


def add_lights(server: viser.ViserServer, scene: Scene) -> None:
    """Light the scene from its own sun's direction, strongly enough that a face in the sun shows its own colour.

    A surface returns colour · (sun · cos + sky) / π, so the two add up to about π.
    """
    server.scene.configure_default_lights(enabled=False)
    server.scene.configure_environment_map(None)  # its reflections would tint a robot's colours
    direction = np.array(scene.lights[0].direction if scene.lights else _SUN_DIRECTION)
    server.scene.add_light_directional(
        "/sun", intensity=2.3, cast_shadow=True, position=tuple(-10.0 * direction / np.linalg.norm(direction))
    )
    server.scene.add_light_hemisphere("/sky", sky_color=(255, 255, 255), ground_color=(150, 145, 140), intensity=1.5)


def add_grid(server: viser.ViserServer, name: str) -> viser.GridHandle:
    """Draw lines every metre, fading with distance."""
    return server.scene.add_grid(
        name,
        infinite_grid=True,
        width=2.0,  # viser stretches an infinite grid to width · (1 + fade_distance): as far as its lines are seen
        height=2.0,
        cell_size=1.0,
        section_size=5.0,
        cell_color=(120, 122, 126),
        section_color=(95, 97, 102),
        cell_thickness=0.8,
        section_thickness=1.2,
        fade_distance=60.0,
        fade_strength=2.0,
        shadow_opacity=0.25,
        position=(0.0, 0.0, _GRID_LIFT_M),
    )


def sky(scene: Scene) -> NDArray[np.uint8]:
    """Shade the scene's background colour from a little darker above to lighter at the horizon, (rows, 2, 3)."""
    base = np.array(scene.background[:3]) * 255.0
    shade = np.interp(np.linspace(0.0, 1.0, _SKY_ROWS_PX), [0.0, 0.5, 1.0], [0.98, 1.25, 1.15])
    rows = np.clip(shade[:, None] * base[None, :], 0, 255).astype(np.uint8)
    return np.repeat(rows[:, None, :], 2, axis=1)
