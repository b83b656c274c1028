"""Images of textures: PNG and JPEG unchanged, others as PNG."""

from functools import lru_cache
from io import BytesIO

import numpy as np
from msgspec import Struct

from trundle.robots.meshes import Texture, ignored_decoder_warnings, image_file
from trundle.sim.render import LARGEST_TEXTURE_PX, load_texture

_KEPT = {"PNG": "image/png", "JPEG": "image/jpeg"}


class EncodedImage(Struct, frozen=True):
    """Image file."""

    data: bytes
    mime: str

    @property
    def suffix(self) -> str:
        """File suffix, with its dot."""
        return ".jpg" if self.mime == "image/jpeg" else ".png"


def encode_image(texture: Texture) -> EncodedImage | None:
    """Return an image as PNG or JPEG, at most 4096 px wide and high; None if it cannot be read."""
    try:
        return _encode(texture, 0 if isinstance(texture, bytes) else texture.stat().st_mtime_ns)
    except OSError:
        return None


@lru_cache(maxsize=64)
def _encode(texture: Texture, _changed_ns: int) -> EncodedImage | None:
    from PIL import Image

    file = image_file(texture)
    try:
        with ignored_decoder_warnings(), Image.open(file) as image:
            if image.format in _KEPT and max(image.size) <= LARGEST_TEXTURE_PX:
                return EncodedImage(file.getvalue(), _KEPT[image.format])
    except Exception:  # every decoder of Pillow has its own exceptions
        return None
    pixels = load_texture(texture)
    if not isinstance(pixels, np.ndarray):
        return None
    png = BytesIO()
    Image.fromarray(pixels).save(png, "PNG", compress_level=6)
    return EncodedImage(png.getvalue(), "image/png")
