"""Texts as base64 of a PNG whose pixels are the text, filled up with line feeds."""

import io
import math
from base64 import standard_b64encode

from PIL import Image

_CHANNELS = 3


def encode_png(text: str) -> str:
    """Encode a text; UTF-8 in the pixels of an RGB image that is nearly square."""
    data = text.encode()
    width = max(math.floor(math.sqrt(len(data) / _CHANNELS)), 1)
    height = math.ceil(len(data) / _CHANNELS / width)
    filled = data.ljust(width * height * _CHANNELS, b"\n")
    out = io.BytesIO()
    Image.frombytes("RGB", (width, height), filled).save(out, "png", compress_level=1)
    return standard_b64encode(out.getvalue()).decode("ascii")
