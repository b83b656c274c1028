"""ros_numpy: geometry, images, grids, clouds, errors."""

import numpy as np
from geometry_msgs.msg import Point, Pose, Quaternion, Transform, Vector3
from nav_msgs.msg import OccupancyGrid
from sensor_msgs.msg import Image, PointCloud2, PointField
from std_msgs.msg import String

import ros_numpy


def show(array):
    """Type, shape, content."""
    array = np.asarray(array)
    return (array.dtype.kind, array.shape, np.round(array, 6).tolist() if array.dtype.names is None else array.tolist())


print(show(ros_numpy.numpify(Vector3(1, 2, 3))), show(ros_numpy.numpify(Vector3(1, 2, 3), hom=True)))
print(show(ros_numpy.numpify(Point(1, 2, 3), hom=True)), show(ros_numpy.numpify(Quaternion(0, 0, 0, 1))))
pose = Pose(Point(1, 2, 3), Quaternion(0, 0, 0.6, 0.8))
matrix = ros_numpy.numpify(pose)
print(show(matrix))
back = ros_numpy.msgify(Pose, matrix)
print(back.position.x, round(back.orientation.z, 6), round(back.orientation.w, 6))
transform = ros_numpy.msgify(Transform, matrix)
print(transform.translation.z, show(ros_numpy.numpify(transform))[1])
print(ros_numpy.msgify(Vector3, np.array([1.0, 2, 3])).y, ros_numpy.msgify(Point, np.array([2.0, 4, 6, 2])).z)
print(
    [float(p.x) for p in ros_numpy.msgify(Point, np.array([[1.0, 2, 3], [4, 5, 6]]))],
    ros_numpy.msgify(Quaternion, np.eye(4)[3]).w,
)
pixels = np.arange(24, dtype=np.uint8).reshape(2, 4, 3)
image = ros_numpy.msgify(Image, pixels, encoding="rgb8")
print(image.encoding, image.width, image.height, image.step, bool(image.is_bigendian), len(image.data))
gray = ros_numpy.msgify(Image, np.array([[1, 2], [3, 4]], dtype=np.uint16), encoding="mono16")
print(gray.step, list(bytes(gray.data)))
cells = np.ma.array(np.array([[0, 100], [-1, 50]], dtype=np.int8), mask=[[False, False], [True, False]])
grid = ros_numpy.msgify(OccupancyGrid, cells)
print(grid.info.width, grid.info.height, [int(v) for v in grid.data])
again = ros_numpy.numpify(OccupancyGrid(info=grid.info, data=[0, 100, -1, 50]))
print(type(again).__name__, again.mask.tolist(), again.filled().tolist())
points = np.zeros(
    3,
    dtype=[("x", np.float32), ("y", np.float32), ("z", np.float32), ("r", np.uint8), ("g", np.uint8), ("b", np.uint8)],
)
points["x"], points["z"], points["r"], points["b"] = [1, 2, np.nan], 5, 200, [1, 2, 3]
cloud = ros_numpy.msgify(PointCloud2, points, frame_id="cam")
print(cloud.width, cloud.height, cloud.point_step, cloud.is_dense, cloud.header.frame_id)
print([(f.name, f.offset, f.datatype, f.count) for f in cloud.fields])
array = ros_numpy.numpify(cloud)
print(array.dtype.names, array.shape, array["b"].tolist())
merged = ros_numpy.point_cloud2.merge_rgb_fields(points[:2])
print(merged.dtype.names, merged["rgb"].view(np.uint32).tolist())
print(
    ros_numpy.point_cloud2.split_rgb_field(merged)["b"].tolist(),
    ros_numpy.point_cloud2.split_rgb_field(merged).dtype.names,
)
print(show(ros_numpy.point_cloud2.pointcloud2_to_xyz_array(cloud)))
print(ros_numpy.point_cloud2.get_xyz_points(array, remove_nans=False).shape)
fields = [PointField("a", 2, PointField.INT16, 1), PointField("v", 8, PointField.FLOAT32, 2)]
print(
    ros_numpy.point_cloud2.fields_to_dtype(fields, 18)[-1][0], len(ros_numpy.point_cloud2.fields_to_dtype(fields, 18))
)
for bad in (
    lambda: ros_numpy.msgify(Image, pixels, encoding="mono8"),
    lambda: ros_numpy.msgify(Image, pixels.astype(float), encoding="rgb8"),
    lambda: ros_numpy.msgify(Image, pixels, encoding="nope"),
    lambda: ros_numpy.msgify(String, pixels),
    lambda: ros_numpy.msgify(OccupancyGrid, np.zeros(3, np.int8)),
):
    try:
        bad()
    except (TypeError, ValueError) as error:
        print(type(error).__name__)
print(ros_numpy.numpify(None))
