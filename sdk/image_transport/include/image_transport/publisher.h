#pragma once

#include <ros/node_handle.h>
#include <sensor_msgs/Image.h>

#include <string>

#include "image_transport/single_subscriber_publisher.h"

namespace image_transport {

/** Publisher of images by all transports that are there. */
class Publisher {
 public:
  Publisher() {}
  /** Subscribers of all transports. */
  uint32_t getNumSubscribers() const;
  /** Base topic. */
  std::string getTopic() const;
  void publish(const sensor_msgs::Image& message) const;
  void publish(const sensor_msgs::ImageConstPtr& message) const;
  void shutdown();
  operator void*() const;
  bool operator<(const Publisher& other) const { return impl_ < other.impl_; }
  bool operator==(const Publisher& other) const { return impl_ == other.impl_; }
  bool operator!=(const Publisher& other) const { return !(*this == other); }

 private:
  friend class ImageTransport;
  struct Impl;
  Publisher(ros::NodeHandle& nh, const std::string& base_topic, uint32_t queue_size,
            const SubscriberStatusCallback& connect_cb, const SubscriberStatusCallback& disconnect_cb,
            const ros::VoidPtr& tracked_object, bool latch);
  boost::shared_ptr<Impl> impl_;
};

}  // namespace image_transport
