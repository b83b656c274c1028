"""Conversion of map images to occupancy grids and back, by map_server's rules."""

import io
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import yaml
from numpy.typing import NDArray
from PIL import Image

from trundle.base.atomic_write import write_atomically
from trundle.base.diagnostics import UsageError
from trundle.base.files import read_file
from trundle.base.yaml_loader import load_yaml
from trundle.robots.meshes import decoding_error, ignored_decoder_warnings
from trundle.robots.parameters import ParamError, RosParameters

_FREE, _OCCUPIED, _UNKNOWN = 0, 100, -1
_KEYS = ("image", "origin", "resolution", "negate", "occupied_thresh", "free_thresh")
_MAX_BYTES = 256 * 1024 * 1024
_MAX_PIXELS = 100_000_000


@dataclass(frozen=True, slots=True, kw_only=True)
class OccupancyGrid:
    """Grid of cells; row 0 is the bottom of the image."""

    cells: NDArray[np.int8]
    """(height, width): −1 unknown, 0 free … 100 occupied."""
    resolution_m: float
    origin: tuple[float, float, float]
    """x, y [m] and yaw [rad] of the lower left corner."""


def read_map(file: Path) -> OccupancyGrid:
    """Read a map's YAML file and its image.

    Raises:
        UsageError: a file or key is missing or invalid.
    """
    try:
        metadata: Any = load_yaml(read_file(file).decode())
    except (OSError, yaml.YAMLError, UnicodeDecodeError) as error:
        raise UsageError(f"map {file}: {error}") from None
    if not isinstance(metadata, dict):
        raise UsageError(f"map {file}: not a YAML mapping")
    missing = [key for key in _KEYS if metadata.get(key) is None]
    if missing:
        raise UsageError(f"map {file}: the key {missing[0]!r} is missing")
    values = RosParameters(metadata, f"{file}:")
    try:
        x, y, yaw = values.vector("origin")
        resolution_m, negate = values.number("resolution"), values.flag("negate")
        occupied, free = values.number("occupied_thresh"), values.number("free_thresh")
        image_path, mode = file.parent / values.text("image"), values.text("mode", "trinary")
    except ParamError as error:
        raise UsageError(f"map {file}: {str(error).removeprefix(f'parameter {file}:/')}") from None
    if mode not in ("trinary", "scale", "raw"):
        raise UsageError(f"map {file}: no mode {mode!r}; modes: trinary, scale, raw")
    if mode == "scale" and not free < occupied:
        raise UsageError(f"map {file}: free_thresh must be < occupied_thresh to scale, got {free:g} and {occupied:g}")
    cells = read_cells(image_path, negate=negate, occupied=occupied, free=free, mode=mode)
    return OccupancyGrid(cells=cells, resolution_m=positive(resolution_m, file), origin=(x, y, yaw))


def positive(resolution_m: float, file: Path) -> float:
    """Check a map's resolution.

    Raises:
        UsageError: the resolution is not positive and finite.
    """
    if not 0.0 < resolution_m < math.inf:
        raise UsageError(f"map {file}: resolution must be > 0 m, got {resolution_m:g}")
    return resolution_m


def read_cells(picture: Path, *, negate: bool, occupied: float, free: float, mode: str = "trinary") -> NDArray[np.int8]:
    """Read an image as occupancies.

    Args:
        picture: image; dark is occupied.
        negate: True: light is occupied.
        occupied: threshold of occupancy [0, 1]; cells above are occupied.
        free: threshold of occupancy [0, 1]; cells below are free.
        mode: cells between the thresholds become unknown (trinary) or scaled (scale); raw: grey values are occupancies.

    Raises:
        UsageError: the file is not an image.
    """
    return _cells(_pixels(picture), negate=negate, occupied=occupied, free=free, mode=mode)


def _pixels(picture: Path) -> NDArray[np.float64]:
    """Return the pixels (height, width, channels) 0 … 255; the last of two or four channels is alpha."""
    try:
        with ignored_decoder_warnings(), Image.open(io.BytesIO(read_file(picture, max_bytes=_MAX_BYTES))) as image:
            if image.width * image.height > _MAX_PIXELS:
                raise UsageError(
                    f"{picture}: {image.width} × {image.height} pixels exceed the limit of {_MAX_PIXELS} for maps"
                )
            converted = image if image.mode in ("L", "LA", "RGB", "RGBA") else image.convert("L")
            pixels = np.asarray(converted, dtype=np.float64)
    except UsageError:
        raise
    except Exception as error:  # every decoder of Pillow has its own exceptions
        raise UsageError(f"{picture}: {decoding_error(error)}") from None
    return pixels[:, :, None] if pixels.ndim == 2 else pixels


def _cells(pixels: NDArray[np.float64], *, negate: bool, occupied: float, free: float, mode: str) -> NDArray[np.int8]:
    has_opacity = pixels.shape[2] in (2, 4)
    # In trinary mode, the original averages alpha with the colors.
    channels = pixels[:, :, :-1] if has_opacity and mode != "trinary" else pixels
    brightness = 255.0 - channels.mean(axis=2) if negate else channels.mean(axis=2)
    if mode == "raw":  # byte by byte: −1 becomes 255
        return np.flipud(brightness).astype(np.uint8).view(np.int8)
    occupancy = (255.0 - brightness) / 255.0
    intermediate = np.full_like(occupancy, _UNKNOWN)
    if mode == "scale":
        intermediate = np.floor(1.0 + 98.0 * np.clip((occupancy - free) / (occupied - free), 0.0, 1.0))
        if has_opacity:
            intermediate[pixels[:, :, -1] < 1.0] = _UNKNOWN
    cells = np.where(occupancy > occupied, _OCCUPIED, np.where(occupancy < free, _FREE, intermediate))
    return np.flipud(cells).astype(np.int8)


def write_map(file: Path, grid: OccupancyGrid, *, occupied: int, free: int) -> None:
    """Write `file`.pgm and `file`.yaml; cells between the thresholds [%] have the grey of unknown cells.

    Raises:
        UsageError: a file cannot be written.
    """
    cells = np.flipud(grid.cells)
    shades = np.full(cells.shape, 205, dtype=np.uint8)
    shades[(cells >= 0) & (cells <= free)] = 254
    shades[cells >= occupied] = 0
    picture = file.with_name(f"{file.name}.pgm")
    height, width = grid.cells.shape
    header = f"P5\n# CREATOR: map_saver.cpp {grid.resolution_m:.3f} m/pix\n{width} {height}\n255\n"
    write_atomically(picture, header.encode() + shades.tobytes())
    x, y, yaw = grid.origin
    write_atomically(
        file.with_name(f"{file.name}.yaml"),
        f"image: {picture.name}\nresolution: {grid.resolution_m:f}\norigin: [{x:f}, {y:f}, {yaw:f}]\n"
        "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n\n",
    )
