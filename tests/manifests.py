"""Manifests of simulated worlds, for tests of the page's server."""

from typing import Any

from msgspec.structs import replace

from trundle.page.world.manifest import Manifest, PhysicsSettings, SceneSettings

_GREY = (0.5, 0.5, 0.5)


def empty_manifest(generation: int, **changes: Any) -> Manifest:
    """Return a world without models, with some fields changed."""
    scene = SceneSettings(ambient=_GREY, background=_GREY, sky=False, shadows=True, grid=True, fog=None)
    physics = PhysicsSettings(gravity=(0.0, 0.0, -9.8), wind=(0.0, 0.0, 0.0), step=0.001)
    return replace(Manifest(generation=generation, name="empty", scene=scene, physics=physics), **changes)
