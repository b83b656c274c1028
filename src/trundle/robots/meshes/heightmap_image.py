"""Heightmaps from grey images."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .mesh import MeshError
from .texture import decoding_error, ignored_decoder_warnings, image_file

_MAX_PIXELS = 4096
"""Maximum side of an image [px]."""
MAX_SAMPLES = 1025
"""Maximum number of samples per side of the terrain; larger images are reduced."""


def read_heights(path: Path, *, sampling: int = 1, max_samples: int = MAX_SAMPLES) -> NDArray[np.float32]:
    """Read an image as (rows, columns) heights from 0 (black) to 1 (white), upper edge first.

    Args:
        path: grey image of 8 or 16 bit; others are converted.
        sampling: samples per pixel and axis.
        max_samples: maximum samples per side.

    Raises:
        MeshError: the image cannot be read, is too large, or is a single line.
    """
    from PIL import Image  # slow to load, and few worlds have terrain

    try:
        with ignored_decoder_warnings(), Image.open(image_file(path)) as image:
            if max(image.size) > _MAX_PIXELS or min(image.size) < 2:
                raise MeshError(f"{image.size[0]} by {image.size[1]} pixels; 2 to {_MAX_PIXELS} are possible")
            deep = image.mode in ("I", "F") or image.mode.startswith("I;")
            grey = image if deep else image.convert("L")
            columns, rows = (min((n - 1) * max(sampling, 1) + 1, max_samples) for n in image.size)
            heights = np.asarray(grey.convert("F").resize((columns, rows), Image.Resampling.BILINEAR))
            if not np.isfinite(heights).all():
                raise MeshError("heights that are not finite")
            return (heights / (65535.0 if deep else 255.0)).astype(np.float32)
    except MeshError:
        raise
    except Exception as error:
        raise MeshError(decoding_error(error)) from None
