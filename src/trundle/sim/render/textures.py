"""Textures of shapes."""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from trundle.base.diagnostics import Diagnostics, Source
from trundle.robots.meshes import Texture, decoding_error, ignored_decoder_warnings, image_file

from .scene import Scene

_MAX_PIXELS = 64 * 1024 * 1024
LARGEST_TEXTURE_PX = 4096
"""Largest side [px]; a larger image is reduced."""


@lru_cache(maxsize=64)
def load_texture(texture: Texture) -> NDArray[np.uint8] | str:
    """Read an image as (height, width, 3), top row first; return the reason if it cannot be read."""
    from PIL import Image  # slow to load, and robots of plain shapes have no textures

    try:
        with ignored_decoder_warnings(), Image.open(image_file(texture)) as image:
            if image.width * image.height > _MAX_PIXELS:
                return f"it has {image.width} x {image.height} pixels, more than {_MAX_PIXELS}"
            if max(image.size) > LARGEST_TEXTURE_PX:
                image.thumbnail((LARGEST_TEXTURE_PX, LARGEST_TEXTURE_PX))
            return np.ascontiguousarray(np.asarray(image.convert("RGB")))
    except Exception as error:  # every decoder of Pillow raises its own exceptions
        return decoding_error(error)


def report_unreadable_textures(scene: Scene, report: Diagnostics) -> None:
    """Warn of textures that cannot be drawn, at their file, or at the visual for a texture inside a mesh file."""
    for shape in scene.shapes:
        if shape.texture is None:
            continue
        image = load_texture(shape.texture)
        if isinstance(image, str):
            visual = f"{scene.bodies[shape.body]}::{shape.name}"
            at = Source(visual if isinstance(shape.texture, bytes) else str(shape.texture))
            report.warn(at, f"the texture cannot be read: {image}; a plain color is drawn", "texture")
