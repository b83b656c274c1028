"""Small valid inputs: files of `seeds/` and generated pictures."""

import io
from pathlib import Path

import numpy as np
from PIL import Image

FOLDER = Path(__file__).parent / "seeds"


def seed(name: str) -> bytes:
    """Return a file of `seeds/`."""
    return (FOLDER / name).read_bytes()


def picture(kind: str, mode: str = "RGB", side: int = 9, **options: object) -> bytes:
    """Return a small encoded picture."""
    channels = {"RGB": 3, "RGBA": 4}.get(mode)
    kinds = {"I;16": np.uint16, "F": np.float32}
    values = np.arange(side * side * (channels or 1)) % 251 * (257 if mode == "I;16" else 1)
    pixels = values.astype(kinds.get(mode, np.uint8)).reshape((side, side, channels) if channels else (side, side))
    buffer = io.BytesIO()
    image = Image.fromarray(pixels)
    (image.convert(mode) if mode in ("P", "1") else image).save(buffer, kind, **options)
    return buffer.getvalue()
