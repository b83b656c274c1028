#pragma once

#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <string>

#include "image_transport/camera_common.h"
#include "image_transport/subscriber.h"

namespace image_transport {

/** Subscription of images, each with the calibration of the same stamp. */
class CameraSubscriber {
 public:
  typedef boost::function<void(const sensor_msgs::ImageConstPtr&, const sensor_msgs::CameraInfoConstPtr&)> Callback;

  CameraSubscriber() {}
  std::string getTopic() const;
  std::string getInfoTopic() const;
  uint32_t getNumPublishers() const;
  std::string getTransport() const;
  void shutdown();
  operator void*() const { return impl_.get(); }
  bool operator<(const CameraSubscriber& other) const { return impl_ < other.impl_; }
  bool operator==(const CameraSubscriber& other) const { return impl_ == other.impl_; }
  bool operator!=(const CameraSubscriber& other) const { return !(*this == other); }

 private:
  friend class ImageTransport;
  struct Impl;
  CameraSubscriber(ros::NodeHandle& nh, const std::string& base_topic, uint32_t queue_size, const Callback& callback,
                   const ros::VoidPtr& tracked_object, const TransportHints& transport_hints);
  boost::shared_ptr<Impl> impl_;
};

}  // namespace image_transport
