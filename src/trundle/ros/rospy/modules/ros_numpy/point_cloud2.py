"""PointCloud2 messages as structured arrays."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from sensor_msgs.msg import PointCloud2, PointField

from .registry import converts_from_numpy, converts_to_numpy

if TYPE_CHECKING:
    from numpy.typing import DTypeLike, NDArray

DUMMY_FIELD_PREFIX = "__"
"""Prefix of the names of padding between fields."""

type_mappings = [
    (getattr(PointField, name.upper()), np.dtype(name))
    for name in ("int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64")
]
pftype_to_nptype = dict(type_mappings)
nptype_to_pftype = {dtype: number for number, dtype in type_mappings}
pftype_sizes = {number: dtype.itemsize for number, dtype in type_mappings}


@converts_to_numpy(PointField, plural=True)
def fields_to_dtype(fields: Sequence[Any], point_step: int) -> list[tuple[str, Any]]:
    """List of (name, type) from PointFields, with padding bytes between them."""
    columns: list[tuple[str, Any]] = []
    end = 0

    def pad(until: int) -> None:
        columns.extend((f"{DUMMY_FIELD_PREFIX}{offset}", np.uint8) for offset in range(end, until))

    for field in fields:
        pad(field.offset)
        dtype = pftype_to_nptype[field.datatype]
        columns.append((field.name, dtype if field.count == 1 else np.dtype((dtype, field.count))))
        end = max(end, field.offset) + dtype.itemsize * field.count
    pad(point_step)
    return columns


@converts_from_numpy(PointField, plural=True)
def dtype_to_fields(dtype: Any) -> list[Any]:
    """List of PointFields from a structured type."""
    fields: list[Any] = []
    for name in dtype.names:
        kind, offset = dtype.fields[name][:2]
        element, shape = kind.subdtype or (kind, ())
        fields.append(PointField(name, offset, nptype_to_pftype[element], int(np.prod(shape))))
    return fields


@converts_to_numpy(PointCloud2)
def pointcloud2_to_array(cloud_msg: Any, squeeze: bool = True) -> "NDArray[Any]":
    """Structured array (height, width); (width,) of an unorganized cloud with `squeeze`."""
    columns = fields_to_dtype(cloud_msg.fields, cloud_msg.point_step)
    points = np.frombuffer(cloud_msg.data, columns)
    points = points[[name for name, _ in columns if not name.startswith(DUMMY_FIELD_PREFIX)]]
    is_flat = squeeze and cloud_msg.height == 1
    return points.reshape(cloud_msg.width if is_flat else (cloud_msg.height, cloud_msg.width))


@converts_from_numpy(PointCloud2)
def array_to_pointcloud2(cloud_arr: "NDArray[Any]", stamp: Any = None, frame_id: str | None = None) -> Any:
    """PointCloud2 from a structured array, (N,) or (height, width)."""
    cloud_arr = np.atleast_2d(cloud_arr)
    dtype: Any = cloud_arr.dtype
    cloud = PointCloud2(
        height=cloud_arr.shape[0],
        width=cloud_arr.shape[1],
        fields=dtype_to_fields(dtype),
        is_bigendian=False,
        point_step=dtype.itemsize,
        row_step=dtype.itemsize * cloud_arr.shape[1],
        is_dense=bool(all(np.isfinite(cloud_arr[name]).all() for name in dtype.names)),
        data=cloud_arr.tobytes(),
    )
    if stamp is not None:
        cloud.header.stamp = stamp
    if frame_id is not None:
        cloud.header.frame_id = frame_id
    return cloud


def merge_rgb_fields(cloud_arr: "NDArray[Any]") -> "NDArray[Any]":
    """Replace the bytes r, g, b by PCL's rgb: a float32 with their bits."""
    red, green, blue = (np.asarray(cloud_arr[name], dtype=np.uint32) for name in "rgb")
    packed = ((red << 16) | (green << 8) | blue).astype(np.uint32).view(np.float32)
    return _replaced(cloud_arr, ("r", "g", "b"), {"rgb": packed})


def split_rgb_field(cloud_arr: "NDArray[Any]") -> "NDArray[Any]":
    """Replace PCL's rgb by the bytes r, g, b."""
    packed = np.ascontiguousarray(cloud_arr["rgb"], dtype=np.float32).view(np.uint32)
    return _replaced(
        cloud_arr,
        ("rgb",),
        {name: (packed >> shift).astype(np.uint8) for name, shift in zip("rgb", (16, 8, 0), strict=True)},
    )


def get_xyz_points(cloud_array: "NDArray[Any]", remove_nans: bool = True, dtype: "DTypeLike" = float) -> "NDArray[Any]":
    """Points (N, 3) of the fields x, y, z; (height, width, 3) of an organized cloud with its NaNs."""
    if remove_nans:
        cloud_array = cloud_array[np.all([np.isfinite(cloud_array[axis]) for axis in "xyz"], axis=0)]
    return np.stack([cloud_array[axis] for axis in "xyz"], axis=-1).astype(dtype)


def pointcloud2_to_xyz_array(cloud_msg: Any, remove_nans: bool = True) -> "NDArray[Any]":
    """`get_xyz_points` of a message."""
    return get_xyz_points(pointcloud2_to_array(cloud_msg), remove_nans=remove_nans)


def _replaced(cloud_arr: "NDArray[Any]", old: Sequence[str], new: "Mapping[str, NDArray[Any]]") -> "NDArray[Any]":
    """Copy an array, replacing fields by new ones at the end."""
    dtype: Any = cloud_arr.dtype
    kept = [(name, dtype.fields[name][0]) for name in dtype.names if name not in old]
    result = np.zeros(cloud_arr.shape, [*kept, *((name, values.dtype) for name, values in new.items())])
    for name, _ in kept:
        result[name] = cloud_arr[name]
    for name, values in new.items():
        result[name] = values
    return result
