"""Parquet shards with embedded pictures, whose columns Hugging Face's `datasets` decodes."""

import os
from pathlib import Path
from typing import Any

from msgspec import json, to_builtins

from trundle.base.extras import import_extra

from ..annotation import PictureAnnotation
from ..dataset_folder import picture_path
from ..plan import DatasetPlan
from .format import DatasetFormat, ReadAll
from .shards import missing_shards

_KINDS = {"image": "images", "depth": "depth", "segmentation": "segmentation"}
"""Column → folder of its pictures."""
_GROUP_PICTURES = 50
"""Pictures per row group, which a reader keeps in memory."""


class ParquetFormat(DatasetFormat):
    """Writer of `parquet/`."""

    def finish(self, plan: DatasetPlan, folder: Path, read: ReadAll) -> None:
        """Write the missing shards.

        Raises:
            UsageError: pyarrow is not installed.
        """
        arrow, parquet = import_extra("pyarrow"), import_extra("pyarrow.parquet")
        schema = _schema(arrow)
        for path, pictures in missing_shards(plan, folder / "parquet", "parquet", read):
            unfinished = path.with_name(f".{path.name}.part")
            with parquet.ParquetWriter(unfinished, schema, compression="zstd") as writer:
                for first in range(0, len(pictures), _GROUP_PICTURES):
                    rows = [_row(folder, picture) for picture in pictures[first : first + _GROUP_PICTURES]]
                    writer.write_table(arrow.Table.from_pylist(rows, schema=schema))
            os.replace(unfinished, path)


def _row(folder: Path, picture: PictureAnnotation) -> dict[str, object]:
    row: dict[str, object] = to_builtins(picture)
    for column, kind in _KINDS.items():
        path = picture_path(kind, picture.number)
        row[column] = {"bytes": (folder / path).read_bytes(), "path": path.name}
    for annotated in picture.objects:
        assert annotated.mask.size == (picture.height, picture.width)
    return row


def _schema(arrow: Any) -> Any:
    """Return the columns: pictures as PNG, and the record's fields by name."""
    real, whole, text = arrow.float64(), arrow.int64(), arrow.string()
    numbers = arrow.list_(real)
    image = arrow.struct([("bytes", arrow.binary()), ("path", text)])
    point = arrow.struct([("name", text), ("world", numbers), ("pixel", numbers), ("is_visible", arrow.bool_())])
    object_type = arrow.struct(
        [
            ("instance", whole),
            ("model", text),
            ("category", text),
            ("world_from_model", numbers),
            ("box", numbers),
            ("amodal_box", numbers),
            ("box_3d", arrow.struct([("world_from_box", numbers), ("size", numbers)])),
            ("pixels", whole),
            ("occlusion", real),
            ("truncation", real),
            ("mask", arrow.struct([("size", arrow.list_(whole)), ("counts", text)])),
            ("key_points", arrow.list_(point)),
        ]
    )
    lens = [(name, real) for name in ("fx", "fy", "cx", "cy")]
    camera = arrow.struct([*lens, ("world_from_camera", numbers)])
    fields = [
        ("number", whole),
        *((column, image) for column in _KINDS),
        ("width", whole),
        ("height", whole),
        ("camera", camera),
        ("camera_from_lidar", numbers),
        ("objects", arrow.list_(object_type)),
    ]
    features = {column: {"_type": "Image"} for column in _KINDS}
    metadata = {"huggingface": json.encode({"info": {"features": features}}).decode()}
    return arrow.schema(fields, metadata=metadata)
