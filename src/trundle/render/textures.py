"""Textures of shapes."""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from trundle.meshes import Texture, image_file

_MAX_PIXELS = 64 * 1024 * 1024
_LARGEST = 4096
"""Largest side [px]; a larger image is reduced."""


@lru_cache(maxsize=64)
def load_texture(texture: Texture) -> NDArray[np.uint8] | None:
    """Read an image as (height, width, 3), top row first; None if it cannot be read."""
    from PIL import Image  # slow to load, and robots of plain shapes have no textures

    try:
        with Image.open(image_file(texture)) as image:
            if image.width * image.height > _MAX_PIXELS:
                return None
            if max(image.size) > _LARGEST:
                image.thumbnail((_LARGEST, _LARGEST))
            return np.ascontiguousarray(np.asarray(image.convert("RGB")))
    except Exception:  # every decoder behind Pillow fails in its own way
        return None
