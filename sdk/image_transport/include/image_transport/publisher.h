#pragma once

#include <ros/publisher.h>
#include <sensor_msgs/Image.h>

#include "image_transport/single_subscriber_publisher.h"

namespace image_transport {

/** Publisher of images. */
class Publisher {
 public:
  Publisher() {}
  uint32_t getNumSubscribers() const { return publisher_.getNumSubscribers(); }
  std::string getTopic() const { return publisher_.getTopic(); }
  void publish(const sensor_msgs::Image& message) const { publisher_.publish(message); }
  void publish(const sensor_msgs::ImageConstPtr& message) const { publisher_.publish(message); }
  void shutdown() { publisher_.shutdown(); }
  operator void*() const { return publisher_; }
  bool operator<(const Publisher& other) const { return publisher_ < other.publisher_; }
  bool operator==(const Publisher& other) const { return publisher_ == other.publisher_; }
  bool operator!=(const Publisher& other) const { return !(*this == other); }

 private:
  friend class ImageTransport;
  explicit Publisher(const ros::Publisher& publisher) : publisher_(publisher) {}
  ros::Publisher publisher_;
};

}  // namespace image_transport
