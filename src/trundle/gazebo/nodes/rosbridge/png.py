"""Texts as base64 PNG: the pixels are the text, padded with line feeds."""

import io
import math
from base64 import standard_b64encode

from PIL import Image

_CHANNELS = 3


def encode_png(text: str) -> str:
    """Encode a text as UTF-8 in the pixels of a nearly square RGB image."""
    data = text.encode()
    width = max(math.floor(math.sqrt(len(data) / _CHANNELS)), 1)
    height = math.ceil(len(data) / _CHANNELS / width)
    padded = data.ljust(width * height * _CHANNELS, b"\n")
    out = io.BytesIO()
    Image.frombytes("RGB", (width, height), padded).save(out, "png", compress_level=1)
    return standard_b64encode(out.getvalue()).decode("ascii")
