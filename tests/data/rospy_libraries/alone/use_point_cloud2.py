"""sensor_msgs.point_cloud2: read and write, chosen fields, NaN, organized clouds, big endian."""

import math
import struct

import numpy as np
from sensor_msgs.msg import PointCloud2, PointField
from std_msgs.msg import Header

from sensor_msgs import point_cloud2

header = Header(frame_id="cam")
cloud = point_cloud2.create_cloud_xyz32(header, [(1, 2, 3), [4.5, 5, float("nan")], (7, 8, 9)])
print(
    cloud.width, cloud.height, cloud.point_step, cloud.row_step, cloud.is_dense, cloud.header.frame_id, len(cloud.data)
)
print([f"{f.name} {f.offset} {f.datatype} {f.count}" for f in cloud.fields])
print(list(point_cloud2.read_points(cloud))[0], list(point_cloud2.read_points(cloud, skip_nans=True)))
print(list(point_cloud2.read_points(cloud, field_names=("z", "x"), skip_nans=False))[0])
print(list(point_cloud2.read_points(cloud, field_names=["x"], uvs=[(2, 0), (0, 0)])))
print(point_cloud2.read_points_list(cloud, field_names=("x", "y"), skip_nans=True))
print(point_cloud2.read_points_list(cloud)[2]._asdict())
fields = [
    PointField("x", 0, PointField.FLOAT32, 1),
    PointField("rgb", 16, PointField.UINT32, 1),
    PointField("normal", 4, PointField.FLOAT32, 2),
    PointField("ring", 20, PointField.UINT16, 1),
    PointField("t", 24, PointField.FLOAT64, 1),
    PointField("i", 32, PointField.INT8, 1),
]
mixed = point_cloud2.create_cloud(
    header, fields, [(1.5, 2, 3, 0xFF8000, 7, 0.125, -3), (2.5, 3, 4, 5, 65535, 1e300, 127)]
)
print(mixed.point_step, mixed.row_step, bytes(mixed.data).hex())
print(list(point_cloud2.read_points(mixed)))
print(list(point_cloud2.read_points(mixed, field_names=["ring", "normal"])))
print(list(point_cloud2.read_points(point_cloud2.create_cloud_xyz32(header, np.arange(6.0).reshape(2, 3)))))
grid = PointCloud2(height=2, width=2, point_step=8, row_step=20, is_bigendian=True)
grid.fields = [PointField("u", 0, PointField.FLOAT32, 1), PointField("v", 4, PointField.INT32, 1)]
grid.data = b"".join(struct.pack(">fififi"[:5], r, r * 10, r + 0.5, r * 10 + 1) + b"pad!" for r in range(2))
print(list(point_cloud2.read_points(grid)), list(point_cloud2.read_points(grid, uvs=[(1, 1), (0, 1)])))
print(list(point_cloud2.read_points(point_cloud2.create_cloud_xyz32(header, []))))
generator = point_cloud2.read_points(cloud)
print(type(generator).__name__, math.isnan(list(generator)[1][2]))
try:
    list(point_cloud2.read_points("no cloud"))
except AssertionError as error:
    print(type(error).__name__)
