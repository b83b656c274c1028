#pragma once

#include <ros/node_handle.h>
#include <sensor_msgs/Image.h>

#include <string>

#include "image_transport/exception.h"
#include "image_transport/transport_hints.h"

namespace image_transport {

/** Subscription of images by one transport. */
class Subscriber {
 public:
  Subscriber() {}
  /** Base topic. */
  std::string getTopic() const;
  uint32_t getNumPublishers() const;
  std::string getTransport() const;
  void shutdown();
  operator void*() const;
  bool operator<(const Subscriber& other) const { return impl_ < other.impl_; }
  bool operator==(const Subscriber& other) const { return impl_ == other.impl_; }
  bool operator!=(const Subscriber& other) const { return !(*this == other); }

 private:
  friend class ImageTransport;
  struct Impl;
  Subscriber(ros::NodeHandle& nh, const std::string& base_topic, uint32_t queue_size,
             const boost::function<void(const sensor_msgs::ImageConstPtr&)>& callback,
             const ros::VoidPtr& tracked_object, const TransportHints& transport_hints);
  boost::shared_ptr<Impl> impl_;
};

}  // namespace image_transport
