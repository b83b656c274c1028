"""Shards: files with the pictures of consecutive numbers."""

from collections.abc import Iterator
from pathlib import Path

from ..annotation import PictureAnnotation
from ..plan import DatasetPlan
from .format import ReadAll

SHARD_PICTURES = 500


def missing_shards(
    plan: DatasetPlan, folder: Path, ending: str, read: ReadAll
) -> Iterator[tuple[Path, list[PictureAnnotation]]]:
    """Yield the path of each missing shard, named by its first and last number, and its pictures."""
    folder.mkdir(exist_ok=True)
    pictures: list[PictureAnnotation] = []
    for picture in read():
        pictures.append(picture)
        if len(pictures) == SHARD_PICTURES or picture.number == plan.count - 1:
            path = folder / f"{pictures[0].number:06}-{picture.number:06}.{ending}"
            if not path.exists():
                yield path, pictures
            pictures = []
