#pragma once

#include <sensor_msgs/CameraInfo.h>

#include <algorithm>

#include "image_transport/publisher.h"

namespace image_transport {

/** Publisher of images, each with its camera's calibration. */
class CameraPublisher {
 public:
  CameraPublisher() {}
  uint32_t getNumSubscribers() const { return std::max(image_.getNumSubscribers(), info_.getNumSubscribers()); }
  std::string getTopic() const { return image_.getTopic(); }
  std::string getInfoTopic() const { return info_.getTopic(); }
  void publish(const sensor_msgs::Image& image, const sensor_msgs::CameraInfo& info) const {
    image_.publish(image);
    info_.publish(info);
  }
  void publish(const sensor_msgs::ImageConstPtr& image, const sensor_msgs::CameraInfoConstPtr& info) const {
    image_.publish(image);
    info_.publish(info);
  }
  void publish(sensor_msgs::Image& image, sensor_msgs::CameraInfo& info, ros::Time stamp) const {
    image.header.stamp = info.header.stamp = stamp;
    publish(image, info);
  }
  void shutdown() {
    image_.shutdown();
    info_.shutdown();
  }
  operator void*() const { return image_; }
  bool operator<(const CameraPublisher& other) const { return image_ < other.image_; }
  bool operator==(const CameraPublisher& other) const { return image_ == other.image_; }
  bool operator!=(const CameraPublisher& other) const { return !(*this == other); }

 private:
  friend class ImageTransport;
  CameraPublisher(const Publisher& image, const ros::Publisher& info) : image_(image), info_(info) {}
  Publisher image_;
  ros::Publisher info_;
};

}  // namespace image_transport
