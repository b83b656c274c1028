"""laser_geometry: every channel, cut-offs, invalid ranges."""

import itertools

from sensor_msgs.msg import LaserScan

from laser_geometry import LaserProjection
from sensor_msgs import point_cloud2

scan = LaserScan(
    angle_min=-1.5, angle_max=1.5, angle_increment=0.5, time_increment=0.01, range_min=0.2, range_max=8.0,
    ranges=[1.0, 0.1, 2.5, float("inf"), float("nan"), 7.9, 8.0], intensities=[5, 4, 3, 2, 1, 0, 9],
)  # fmt: skip
scan.header.frame_id = "laser"
projection = LaserProjection()
option = LaserProjection.ChannelOption
for chosen in (option.NONE, option.DEFAULT, option.DISTANCE | option.TIMESTAMP, 31):
    for cutoff in (-1.0, 2.0, 100.0):
        cloud = projection.projectLaser(scan, cutoff, chosen)
        print(
            cloud.header.frame_id, cloud.width, cloud.point_step, [(f.name, f.offset, f.datatype) for f in cloud.fields]
        )
        for point in point_cloud2.read_points(cloud):
            print([round(value, 5) + 0 for value in point])
scan.intensities = []
print([f.name for f in projection.projectLaser(scan).fields], list(itertools.islice(vars(option), 0)))
