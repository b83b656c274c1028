"""Textures of meshes: files and mean colors."""

import io
import os
import warnings
from collections.abc import Generator
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

from trundle.base.files import read_file

from .mesh import Rgba, Texture

if TYPE_CHECKING:
    from PIL.Image import Image

_MAX_BYTES = 256 * 1024 * 1024
_MAX_PIXELS = 64 * 1024 * 1024
_BOX_FILTER = 4
"""Pillow's number of its BOX filter, an average."""


def find_texture(name: str, mesh: Path) -> Path | None:
    """Return a texture's file in the mesh's folder or the model's texture folders; None if elsewhere."""
    model = mesh.parent.parent
    relative = Path(name.replace("\\", "/"))
    candidates = (
        mesh.parent / relative,
        mesh.parent / relative.name,
        model / "materials" / "textures" / relative.name,
        model / "textures" / relative.name,
    )
    inside = os.path.realpath(model)
    existing = (path for path in candidates if os.path.isfile(path))
    return next((path for path in existing if Path(os.path.realpath(path)).is_relative_to(inside)), None)


def image_file(texture: Texture) -> io.BytesIO:
    """Return an image's file for decoding.

    Raises:
        OSError: the file is not regular, too large, or cannot be read.
    """
    return io.BytesIO(texture if isinstance(texture, bytes) else read_file(texture, max_bytes=_MAX_BYTES))


@contextmanager
def ignored_decoder_warnings() -> Generator[None]:
    """Suppress the warnings of Pillow's decoders; their errors are reported by the caller."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        yield


def decoding_error(error: Exception) -> str:
    """Return the message of a decoder's exception, of which Pillow has many kinds."""
    from PIL import UnidentifiedImageError

    if isinstance(error, UnidentifiedImageError):
        return "it is not an image"
    return getattr(error, "strerror", None) or " ".join(str(error).split()) or type(error).__name__


def mean_color(texture: Texture) -> Rgba | None:
    """Return an image's mean color, opaque; None if it cannot be read."""
    try:
        return _mean(texture, 0 if isinstance(texture, bytes) else texture.stat().st_mtime_ns)
    except Exception:  # every decoder of Pillow has its own exceptions
        return None


@lru_cache(maxsize=256)
def _mean(texture: Texture, _changed_ns: int) -> Rgba:
    from PIL import Image

    with ignored_decoder_warnings(), Image.open(image_file(texture)) as image:
        _check_size(image)
        image.draft("RGB", (64, 64))
        pixel = image.convert("RGB").resize((1, 1), resample=_BOX_FILTER).getpixel((0, 0))
    assert isinstance(pixel, tuple)
    r, g, b = (value / 255.0 for value in pixel[:3])
    return (r, g, b, 1.0)


def png_of(texture: Texture) -> bytes | None:
    """Return an image file as PNG bytes; None if it cannot be decoded."""
    from PIL import Image

    try:
        with ignored_decoder_warnings(), Image.open(image_file(texture)) as image:
            return as_png(image)
    except Exception:  # every decoder of Pillow has its own exceptions
        return None


def as_png(image: "Image") -> bytes | None:
    """Return an image as PNG bytes; None if it cannot be encoded."""
    buffer = io.BytesIO()
    try:
        _check_size(image)
        image.convert("RGBA").save(buffer, "PNG", compress_level=1)
    except Exception:  # every decoder of Pillow has its own exceptions
        return None
    return buffer.getvalue()


def _check_size(image: "Image") -> None:
    if image.width * image.height > _MAX_PIXELS:
        raise ValueError("too large")
