"""Grey images as terrain."""

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from .mesh import MeshError
from .texture import image_file, why_undecoded

_MAX_PIXELS = 4096
"""Of each side of an image."""
MAX_SAMPLES = 1025
"""Of each side of the terrain; more is thinned out."""


def read_heights(path: Path, *, sampling: int = 1, most: int = MAX_SAMPLES) -> NDArray[np.float32]:
    """Read an image as (rows, columns) from black, 0, to white, 1; the upper edge first.

    Args:
        path: of a grey image of 8 or 16 bit, or of one that becomes grey.
        sampling: samples for each pixel and axis.
        most: samples of each side.

    Raises:
        MeshError: it cannot be read, or is too large or a mere line.
    """
    from PIL import Image  # slow to load, and few worlds have terrain

    try:
        with Image.open(image_file(path)) as image:
            if max(image.size) > _MAX_PIXELS or min(image.size) < 2:
                raise MeshError(f"{image.size[0]} by {image.size[1]} pixels; 2 to {_MAX_PIXELS} can be used")
            deep = image.mode in ("I", "F") or image.mode.startswith("I;")
            grey = image if deep else image.convert("L")
            columns, rows = (min((n - 1) * max(sampling, 1) + 1, most) for n in image.size)
            heights = np.asarray(grey.convert("F").resize((columns, rows), Image.Resampling.BILINEAR))
            return (heights / (65535.0 if deep else 255.0)).astype(np.float32)
    except MeshError:
        raise
    except Exception as error:
        raise MeshError(why_undecoded(error)) from None
