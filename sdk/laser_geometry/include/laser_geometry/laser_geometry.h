#pragma once

#include <sensor_msgs/LaserScan.h>
#include <sensor_msgs/PointCloud.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf/transform_listener.h>
#include <tf2/buffer_core.h>

#include <string>

#ifdef __has_include
#if __has_include(<Eigen/Core>)
#include <Eigen/Core>  // programs use it without including it
#endif
#endif

namespace laser_geometry {

/** Which values of a scan a cloud gets. */
namespace channel_option {
enum ChannelOption {
  None = 0x00,
  Intensity = 0x01,
  Index = 0x02,
  Distance = 0x04,
  Timestamp = 0x08,
  Viewpoint = 0x10,
  Default = Intensity | Index
};
}  // namespace channel_option

/** Makes points of a laser's ranges. */
class LaserProjection {
 public:
  /** Project into the scan's frame; ranges from the cutoff [m] on are left out, a negative one is the scan's range_max.
   */
  void projectLaser(const sensor_msgs::LaserScan& scan_in, sensor_msgs::PointCloud& cloud_out,
                    double range_cutoff = -1.0, int channel_options = channel_option::Default) const;
  void projectLaser(const sensor_msgs::LaserScan& scan_in, sensor_msgs::PointCloud2& cloud_out,
                    double range_cutoff = -1.0, int channel_options = channel_option::Default) const;
  /** Project into another frame, each ray by the transform at its time. Throws tf's exceptions. */
  void transformLaserScanToPointCloud(const std::string& target_frame, const sensor_msgs::LaserScan& scan_in,
                                      sensor_msgs::PointCloud& cloud_out, tf::Transformer& tf, double range_cutoff,
                                      int channel_options = channel_option::Default);
  void transformLaserScanToPointCloud(const std::string& target_frame, const sensor_msgs::LaserScan& scan_in,
                                      sensor_msgs::PointCloud& cloud_out, tf::Transformer& tf,
                                      int channel_options = channel_option::Default);
  void transformLaserScanToPointCloud(const std::string& target_frame, const sensor_msgs::LaserScan& scan_in,
                                      sensor_msgs::PointCloud2& cloud_out, tf::Transformer& tf,
                                      double range_cutoff = -1.0, int channel_options = channel_option::Default);
  void transformLaserScanToPointCloud(const std::string& target_frame, const sensor_msgs::LaserScan& scan_in,
                                      sensor_msgs::PointCloud2& cloud_out, tf2::BufferCore& tf,
                                      double range_cutoff = -1.0, int channel_options = channel_option::Default);
};

}  // namespace laser_geometry
