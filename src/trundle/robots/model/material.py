"""Materials of visuals."""

from pathlib import Path
from typing import TypeAlias

from msgspec import Struct

Rgba: TypeAlias = tuple[float, float, float, float]
"""Red, green, blue, opacity, each 0 to 1."""


class Material(Struct, frozen=True, kw_only=True):
    """Phong material, as Gazebo draws it."""

    ambient: Rgba = (0.3, 0.3, 0.3, 1.0)
    diffuse: Rgba = (0.7, 0.7, 0.7, 1.0)
    specular: Rgba = (0.01, 0.01, 0.01, 1.0)
    emissive: Rgba = (0.0, 0.0, 0.0, 1.0)
    texture: Path | None = None
    """Color texture, tinted by `diffuse`. A mesh's `uv` maps it, v up from the lower edge of the image; other shapes
    are mapped by the renderer.
    """
    named_texture: str | None = None
    """Name of a Gazebo material in `TEXTURE_COLORS` whose texture is drawn where `texture` is None."""
    texture_scale: tuple[float, float] = (1.0, 1.0)
    """Texture scale across and up about the image centre, as Ogre's `scale`: uv → (uv − ½) / scale + ½; 0.5 repeats the
    image twice.
    """


GREY = Material()
"""`Gazebo/Grey`, Gazebo's material for a visual without one."""
