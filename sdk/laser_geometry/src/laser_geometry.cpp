#include "laser_geometry/laser_geometry.h"

#include <sensor_msgs/point_cloud2_iterator.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <vector>

namespace laser_geometry {
namespace {

using channel_option::Distance;
using channel_option::Index;
using channel_option::Intensity;
using channel_option::Timestamp;
using channel_option::Viewpoint;

struct Point {
  tf2::Vector3 position, viewpoint;
  float intensity, distance, stamp;
  int index;
};
/** Transform of a ray after a part of the scan's time, from 0 to 1. */
typedef std::function<tf2::Transform(double part)> TransformAt;

std::vector<Point> points(const sensor_msgs::LaserScan& scan, double cutoff, const TransformAt& transform_at) {
  const double end = cutoff < 0.0 ? scan.range_max : std::min<double>(cutoff, scan.range_max);
  std::vector<Point> result;
  result.reserve(scan.ranges.size());
  const double last = scan.ranges.size() > 1 ? static_cast<double>(scan.ranges.size() - 1) : 1.0;
  for (size_t i = 0; i < scan.ranges.size(); ++i) {
    const double range = scan.ranges[i], angle = scan.angle_min + static_cast<double>(i) * scan.angle_increment;
    const bool is_inside = cutoff < 0.0 ? range <= end : range < end;
    if (!(is_inside && range >= scan.range_min)) continue;
    Point point;
    const tf2::Vector3 local(range * std::cos(angle), range * std::sin(angle), 0.0);
    if (transform_at) {
      const tf2::Transform transform = transform_at(static_cast<double>(i) / last);
      point.position = transform * local;
      point.viewpoint = transform.getOrigin();
    } else {
      point.position = local;
      point.viewpoint = tf2::Vector3(0, 0, 0);
    }
    point.intensity = i < scan.intensities.size() ? scan.intensities[i] : 0.0f;
    point.distance = scan.ranges[i];
    point.stamp = static_cast<float>(i) * scan.time_increment;
    point.index = static_cast<int>(i);
    result.push_back(point);
  }
  return result;
}

/** Names of channels, and their values of a point. */
struct Channel {
  const char* name;
  int option;
  std::function<float(const Point&)> value;
};
std::vector<Channel> channels(const sensor_msgs::LaserScan& scan, int options) {
  const std::vector<Channel> all{
      {"intensity", Intensity, [](const Point& p) { return p.intensity; }},
      {"index", Index, [](const Point& p) { return static_cast<float>(p.index); }},
      {"distances", Distance, [](const Point& p) { return p.distance; }},
      {"stamps", Timestamp, [](const Point& p) { return p.stamp; }},
      {"vp_x", Viewpoint, [](const Point& p) { return static_cast<float>(p.viewpoint.x()); }},
      {"vp_y", Viewpoint, [](const Point& p) { return static_cast<float>(p.viewpoint.y()); }},
      {"vp_z", Viewpoint, [](const Point& p) { return static_cast<float>(p.viewpoint.z()); }},
  };
  std::vector<Channel> chosen;
  for (const Channel& channel : all)
    if ((channel.option & options) && (channel.option != Intensity || !scan.intensities.empty()))
      chosen.push_back(channel);
  return chosen;
}

void fill(const sensor_msgs::LaserScan& scan, const std::string& frame, const std::vector<Point>& points, int options,
          sensor_msgs::PointCloud& cloud) {
  cloud = sensor_msgs::PointCloud();
  cloud.header = scan.header;
  cloud.header.frame_id = frame;
  for (const Point& point : points) {
    cloud.points.emplace_back();
    cloud.points.back().x = static_cast<float>(point.position.x());
    cloud.points.back().y = static_cast<float>(point.position.y());
    cloud.points.back().z = static_cast<float>(point.position.z());
  }
  for (const Channel& channel : channels(scan, options)) {
    cloud.channels.emplace_back();
    cloud.channels.back().name = channel.name;
    for (const Point& point : points) cloud.channels.back().values.push_back(channel.value(point));
  }
}

void fill(const sensor_msgs::LaserScan& scan, const std::string& frame, const std::vector<Point>& points, int options,
          sensor_msgs::PointCloud2& cloud) {
  cloud = sensor_msgs::PointCloud2();
  cloud.header = scan.header;
  cloud.header.frame_id = frame;
  int offset = 0;
  for (const char* const axis : {"x", "y", "z"})
    offset = sensor_msgs::addPointField(cloud, axis, 1, sensor_msgs::PointField::FLOAT32, offset);
  const std::vector<Channel> chosen = channels(scan, options);
  for (const Channel& channel : chosen) {
    int type = sensor_msgs::PointField::FLOAT32;
    if (channel.option == Index) type = sensor_msgs::PointField::INT32;
    offset = sensor_msgs::addPointField(cloud, channel.name, 1, type, offset);
  }
  cloud.point_step = static_cast<uint32_t>(offset);
  cloud.is_dense = 1;
  sensor_msgs::PointCloud2Modifier(cloud).resize(points.size());
  uint8_t* at = cloud.data.data();
  const auto put = [&at](const void* value) {
    std::memcpy(at, value, 4);
    at += 4;
  };
  for (const Point& point : points) {
    for (const double coordinate : {point.position.x(), point.position.y(), point.position.z()}) {
      const float value = static_cast<float>(coordinate);
      put(&value);
    }
    for (const Channel& channel : chosen) {
      const float value = channel.value(point);
      put(channel.option == Index ? static_cast<const void*>(&point.index) : &value);
    }
  }
}

tf2::Transform transform(const geometry_msgs::Transform& m) {
  return tf2::Transform(tf2::Quaternion(m.rotation.x, m.rotation.y, m.rotation.z, m.rotation.w),
                        tf2::Vector3(m.translation.x, m.translation.y, m.translation.z));
}

/** Transforms from the first ray's to the last ray's, between which the others are interpolated. */
TransformAt transforms(const std::string& target, const sensor_msgs::LaserScan& scan, const tf2::BufferCore& buffer) {
  const double duration = scan.ranges.empty() ? 0.0 : static_cast<double>(scan.ranges.size() - 1) * scan.time_increment;
  const ros::Time start = scan.header.stamp, end = duration > 0.0 ? start + ros::Duration(duration) : start;
  const tf2::Transform first = transform(buffer.lookupTransform(target, scan.header.frame_id, start).transform);
  const tf2::Transform last = transform(buffer.lookupTransform(target, scan.header.frame_id, end).transform);
  return [first, last](double part) {
    return tf2::Transform(first.getRotation().slerp(last.getRotation(), part),
                          first.getOrigin().lerp(last.getOrigin(), part));
  };
}

}  // namespace

void LaserProjection::projectLaser(const sensor_msgs::LaserScan& scan_in, sensor_msgs::PointCloud& cloud_out,
                                   double range_cutoff, int channel_options) const {
  fill(scan_in, scan_in.header.frame_id, points(scan_in, range_cutoff, TransformAt()), channel_options, cloud_out);
}

void LaserProjection::projectLaser(const sensor_msgs::LaserScan& scan_in, sensor_msgs::PointCloud2& cloud_out,
                                   double range_cutoff, int channel_options) const {
  fill(scan_in, scan_in.header.frame_id, points(scan_in, range_cutoff, TransformAt()), channel_options, cloud_out);
}

void LaserProjection::transformLaserScanToPointCloud(const std::string& target_frame,
                                                     const sensor_msgs::LaserScan& scan_in,
                                                     sensor_msgs::PointCloud& cloud_out, tf::Transformer& tf,
                                                     double range_cutoff, int channel_options) {
  const TransformAt at = transforms(target_frame, scan_in, *tf.getTF2BufferPtr());
  fill(scan_in, target_frame, points(scan_in, range_cutoff, at), channel_options, cloud_out);
}

void LaserProjection::transformLaserScanToPointCloud(const std::string& target_frame,
                                                     const sensor_msgs::LaserScan& scan_in,
                                                     sensor_msgs::PointCloud& cloud_out, tf::Transformer& tf,
                                                     int channel_options) {
  transformLaserScanToPointCloud(target_frame, scan_in, cloud_out, tf, -1.0, channel_options);
}

void LaserProjection::transformLaserScanToPointCloud(const std::string& target_frame,
                                                     const sensor_msgs::LaserScan& scan_in,
                                                     sensor_msgs::PointCloud2& cloud_out, tf::Transformer& tf,
                                                     double range_cutoff, int channel_options) {
  transformLaserScanToPointCloud(target_frame, scan_in, cloud_out, *tf.getTF2BufferPtr(), range_cutoff,
                                 channel_options);
}

void LaserProjection::transformLaserScanToPointCloud(const std::string& target_frame,
                                                     const sensor_msgs::LaserScan& scan_in,
                                                     sensor_msgs::PointCloud2& cloud_out, tf2::BufferCore& tf,
                                                     double range_cutoff, int channel_options) {
  const TransformAt at = transforms(target_frame, scan_in, tf);
  fill(scan_in, target_frame, points(scan_in, range_cutoff, at), channel_options, cloud_out);
}

}  // namespace laser_geometry
