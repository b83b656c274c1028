"""Camera image: colors, depths and segmentation of one instant."""

import io

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.base.diagnostics import UsageError, no_such


class CameraImage(Struct, frozen=True, eq=False, kw_only=True):
    """Image without noise. A notebook shows its colors."""

    __module__ = "trundle"

    time_ns: int
    """Simulation time."""
    rgb: NDArray[np.uint8]
    """(height, width, 3)"""
    depth: NDArray[np.float32] | None
    """(height, width) Depth along the view axis [m]; infinite in the background. None for a wide-angle camera, whose
    image has no such depth.
    """
    segmentation: NDArray[np.int32]
    """(height, width) Index into `names` of the visual at a pixel; −1, its last entry, in the background."""
    names: tuple[str, ...]
    """Names `model::link::visual`; the last is empty."""

    def mask(self, name: str) -> NDArray[np.bool_]:
        """Return the (height, width) mask of a model, link or visual, by `model`, `model::link` or
        `model::link::visual`.

        Raises:
            UsageError: no visual has that name; the message lists the visuals.
        """
        chosen = np.array([full == name or full.startswith(f"{name}::") for full in self.names])
        if not name or not chosen.any():
            raise UsageError(no_such("nothing is called", name, self.names[:-1]))
        return chosen[self.segmentation]

    def _repr_png_(self) -> bytes:
        """Return the colors as PNG, for notebooks."""
        from PIL import Image

        file = io.BytesIO()
        Image.fromarray(self.rgb).save(file, "PNG")
        return file.getvalue()

    def __repr__(self) -> str:
        height, width, _ = self.rgb.shape
        visible = int(np.count_nonzero(np.unique(self.segmentation) >= 0))
        return f"<CameraImage {width}x{height} at {self.time_ns / 1e9:.3f} s: {visible} visuals seen>"
