"""Folder of a dataset, from which a killed run resumes.

A picture is complete once its record exists, which is written last.
"""

import os
from collections.abc import Iterable, Iterator
from io import BytesIO
from pathlib import Path

import numpy as np
from msgspec import MsgspecError, json
from numpy.typing import NDArray
from PIL import Image

from trundle.base.atomic_write import write_atomically
from trundle.base.diagnostics import UsageError

from .annotation import PictureAnnotation
from .picture import AnnotatedPicture
from .plan import DatasetPlan

_RECORDS, _PLAN = "records", "plan.json"
_FOLDERS = ("images", "depth", "segmentation", _RECORDS)
DEPTH_SCALE = 1000.0
"""Depth pictures are in millimetres; 0: background, or farther than 65.535 m."""


def picture_path(kind: str, number: int, ending: str = "png") -> Path:
    """Return the path of a picture's file in the dataset's folder."""
    return Path(kind, f"{number:06}.{ending}")


class DatasetFolder:
    """Folder of one dataset."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def open(self, plan: DatasetPlan, digest: str) -> None:
        """Create the folder, or resume one of the same plan.

        Args:
            plan: plan to save with the pictures.
            digest: digest of all inputs of the pictures.

        Raises:
            UsageError: the folder has the pictures of another plan, or cannot be written.
        """
        try:
            for name in _FOLDERS:
                (self.path / name).mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise UsageError(f"{self.path}: {error.strerror}; give another folder with -o") from None
        path = self.path / _PLAN
        if not path.exists():
            write_atomically(path, json.encode({"digest": digest, "text": plan.text}) + b"\n")
        elif _digest_in(path) != digest:
            reason = "has the pictures of another plan, or the plan, its world or its models have changed since"
            raise UsageError(f"{self.path} {reason}; give another folder with -o, or delete this one")

    def done(self) -> set[int]:
        """Return the numbers of the complete pictures."""
        names = os.listdir(self.path / _RECORDS)
        return {int(name[:-5]) for name in names if name.endswith(".json") and name[:-5].isdecimal()}

    def write(self, picture: AnnotatedPicture) -> None:
        """Write colors, depths and segmentation."""
        number = picture.annotation.number
        for kind, pixels in (
            ("images", picture.rgb),
            ("depth", depth_pixels(picture.depth, DEPTH_SCALE)),
            ("segmentation", picture.instances),
        ):
            (self.path / picture_path(kind, number)).write_bytes(png(pixels))

    def add(self, annotation: PictureAnnotation) -> None:
        """Write a picture's record atomically, which completes the picture."""
        path = self.path / picture_path(_RECORDS, annotation.number, "json")
        unfinished = path.with_suffix(".part")
        unfinished.write_bytes(json.encode(annotation) + b"\n")
        os.replace(unfinished, path)

    def read(self, numbers: Iterable[int]) -> Iterator[PictureAnnotation]:
        """Yield the annotations of pictures.

        Raises:
            UsageError: a record is missing or unreadable.
        """
        for number in numbers:
            path = self.path / picture_path(_RECORDS, number, "json")
            try:
                yield json.decode(path.read_bytes(), type=PictureAnnotation)
            except OSError as error:
                raise UsageError(f"{path}: {error.strerror}") from None
            except MsgspecError as error:
                raise UsageError(f"{path}: {error}; delete it, and the same command makes the picture again") from None


def _digest_in(path: Path) -> str | None:
    """Return the digest in a saved plan; None if the file is damaged."""
    try:
        return json.decode(path.read_bytes(), type=dict[str, str]).get("digest")
    except (OSError, MsgspecError):
        return None


def depth_pixels(depth: NDArray[np.float32], scale: float) -> NDArray[np.uint16]:
    """Return depths in units of 1/scale m; 0 for the background and for more than 65535 units."""
    counts = np.rint(depth * np.float32(scale))
    return np.where(counts <= 65535, counts, 0).astype(np.uint16)


def png(pixels: NDArray[np.uint8] | NDArray[np.uint16]) -> bytes:
    """Encode a picture as PNG with fast compression."""
    file = BytesIO()
    Image.fromarray(pixels).save(file, "PNG", compress_level=1)
    return file.getvalue()
