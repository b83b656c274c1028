"""Reading and writing of PointCloud2 messages."""

import sys
from collections import namedtuple
from collections.abc import Collection, Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from sensor_msgs.msg import PointCloud2, PointField

if TYPE_CHECKING:
    from numpy.typing import NDArray

_TYPES = {
    PointField.INT8: "i1",
    PointField.UINT8: "u1",
    PointField.INT16: "i2",
    PointField.UINT16: "u2",
    PointField.INT32: "i4",
    PointField.UINT32: "u4",
    PointField.FLOAT32: "f4",
    PointField.FLOAT64: "f8",
}
_BLOCK = 1 << 15
"""Number of points converted to tuples at a time."""


def read_points(
    cloud: Any, field_names: Collection[str] | None = None, skip_nans: bool = False, uvs: Iterable[Sequence[int]] = ()
) -> Iterator[tuple[Any, ...]]:
    """Yield each point as a tuple of numbers, in the order of the fields' offsets.

    Args:
        cloud: PointCloud2.
        field_names: fields to read; default: all.
        skip_nans: omit points with a NaN in any of these fields.
        uvs: (column, row) of the points to read; default: all.
    """
    if getattr(cloud, "_type", None) != "sensor_msgs/PointCloud2":
        raise AssertionError("cloud is not a sensor_msgs.msg.PointCloud2")
    dtype = _dtype(cloud.fields, field_names, cloud.is_bigendian, cloud.point_step)
    rows = np.ndarray((cloud.height, cloud.width), dtype, buffer=cloud.data, strides=(cloud.row_step, cloud.point_step))
    pixels = list(uvs)
    if pixels:
        columns, lines = np.array(pixels, dtype=np.intp).T
        rows = rows[lines, columns][None]
    for row in rows:
        for start in range(0, len(row), _BLOCK):
            block = row[start : start + _BLOCK]
            if skip_nans:
                block = block[~_has_nan(block)]
            yield from block.tolist()


def read_points_list(
    cloud: Any, field_names: Collection[str] | None = None, skip_nans: bool = False, uvs: Iterable[Sequence[int]] = ()
) -> list[Any]:
    """List of points as named tuples; see `read_points`."""
    assert cloud._type == "sensor_msgs/PointCloud2", "cloud is not a sensor_msgs.msg.PointCloud2"
    names = [field.name for field in cloud.fields if field_names is None or field.name in field_names]
    point = namedtuple("Point", names)  # pyright: ignore[reportUntypedNamedTuple]
    return [point._make(values) for values in read_points(cloud, field_names, skip_nans, uvs)]


def create_cloud(header: Any, fields: Iterable[Any], points: Any) -> Any:
    """Unorganized PointCloud2.

    Args:
        header: std_msgs Header.
        fields: list of PointField, with offsets.
        points: sequences of numbers, in the order of the offsets; or an array (N, number of fields).
    """
    dtype = _dtype(fields, None, False, None)
    if isinstance(points, np.ndarray) and points.dtype.names is None and points.ndim == 2:
        data = np.zeros(len(points), dtype)
        for name, column in zip(dtype.names, points.T, strict=True):
            data[name] = column
    else:
        rows = [tuple(point) for point in points]
        data = np.zeros(len(rows), dtype)
        data[:] = rows
    return PointCloud2(
        header=header,
        height=1,
        width=len(data),
        is_dense=False,
        is_bigendian=False,
        fields=fields,
        point_step=dtype.itemsize,
        row_step=dtype.itemsize * len(data),
        data=data.tobytes(),
    )


def create_cloud_xyz32(header: Any, points: Any) -> Any:
    """PointCloud2 of the fields x, y, z, as float32."""
    fields = [PointField(name, 4 * index, PointField.FLOAT32, 1) for index, name in enumerate("xyz")]
    return create_cloud(header, fields, points)


def _dtype(
    fields: Iterable[Any], field_names: Collection[str] | None, is_bigendian: bool, point_step: int | None
) -> Any:
    """Structured type of a point: one number per element of a field; by default it ends with the last field."""
    formats: list[str] = []
    offsets: list[int] = []
    end = 0
    order = ">" if is_bigendian else "<"
    for field in sorted(fields, key=lambda field: field.offset):
        if field_names is not None and field.name not in field_names:
            continue
        if field.datatype not in _TYPES:
            print(f"PointField '{field.name}' has the unknown datatype {field.datatype}; skipped", file=sys.stderr)
            continue
        size = int(_TYPES[field.datatype][1])
        for index in range(field.count):
            formats.append(order + _TYPES[field.datatype])
            offsets.append(field.offset + index * size)
        end = max(end, field.offset + field.count * size)
    names = [f"f{index}" for index in range(len(formats))]
    itemsize = max(end, point_step or 0)
    return np.dtype({"names": names, "formats": formats, "offsets": offsets, "itemsize": itemsize})


def _has_nan(block: "NDArray[Any]") -> "NDArray[np.bool_]":
    nan = np.zeros(len(block), bool)
    dtype: Any = block.dtype
    for name in dtype.names:
        if dtype[name].kind == "f":
            nan |= np.isnan(block[name])
    return nan
