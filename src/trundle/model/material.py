"""How a visual looks."""

from pathlib import Path
from typing import TypeAlias

from msgspec import Struct

Rgba: TypeAlias = tuple[float, float, float, float]
"""Red, green, blue, opacity, each 0 to 1."""


class Material(Struct, frozen=True, kw_only=True):
    """Colours of the Phong model that Gazebo draws with."""

    ambient: Rgba = (0.3, 0.3, 0.3, 1.0)
    diffuse: Rgba = (0.7, 0.7, 0.7, 1.0)
    specular: Rgba = (0.01, 0.01, 0.01, 1.0)
    emissive: Rgba = (0.0, 0.0, 0.0, 1.0)
    texture: Path | None = None
    """An image that colours the surface; `diffuse` tints it. A mesh's own `uv` says where it goes, v up from the lower
    edge of the image; other shapes are wrapped by the renderer."""
    texture_scale: tuple[float, float] = (1.0, 1.0)
    """How much larger than the whole image, across and up, about the image's middle: 0.5 repeats it twice. As Ogre's
    `scale`: uv → (uv − ½) / scale + ½."""


GREY = Material()
"""`Gazebo/Grey`, what Gazebo gives a visual without a material."""
