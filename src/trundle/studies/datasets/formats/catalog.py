"""Formats by name."""

from collections.abc import Mapping
from importlib import import_module

from ..plan import Format
from .format import DatasetFormat

_FORMATS: Mapping[Format, str] = {
    "coco": "CocoFormat",
    "kitti": "KittiFormat",
    "mcap": "McapFormat",
    "parquet": "ParquetFormat",
    "semantic_kitti": "SemanticKittiFormat",
    "yolo": "YoloFormat",
}
"""Format, which is also the module's name → class, imported on first use."""


def format_of(name: Format) -> DatasetFormat:
    """Return the writer of a format."""
    return getattr(import_module(f"{__package__}.{name}"), _FORMATS[name])()
