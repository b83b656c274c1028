#pragma once

#include <message_filters/subscriber.h>
#include <message_filters/time_synchronizer.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include "image_transport/camera_common.h"
#include "image_transport/subscriber.h"

namespace image_transport {

/** Subscription of images, each with the calibration of the same stamp. */
class CameraSubscriber {
 public:
  typedef boost::function<void(const sensor_msgs::ImageConstPtr&, const sensor_msgs::CameraInfoConstPtr&)> Callback;

  CameraSubscriber() {}
  std::string getTopic() const { return impl_ ? impl_->images.getTopic() : ""; }
  std::string getInfoTopic() const { return impl_ ? impl_->infos.getTopic() : ""; }
  uint32_t getNumPublishers() const {
    if (!impl_) return 0;
    return std::max(impl_->images.getSubscriber().getNumPublishers(), impl_->infos.getSubscriber().getNumPublishers());
  }
  std::string getTransport() const { return "raw"; }
  void shutdown() { impl_.reset(); }
  operator void*() const { return impl_.get(); }
  bool operator<(const CameraSubscriber& other) const { return impl_ < other.impl_; }
  bool operator==(const CameraSubscriber& other) const { return impl_ == other.impl_; }
  bool operator!=(const CameraSubscriber& other) const { return impl_ != other.impl_; }

 private:
  friend class ImageTransport;
  struct Impl {
    Impl(ros::NodeHandle& node, const std::string& topic, uint32_t queue_size, const TransportHints& hints)
        : images(node, topic, queue_size, hints.getRosHints()),
          infos(node, getCameraInfoTopic(node.resolveName(topic)), queue_size, hints.getRosHints()),
          sync(images, infos, std::max(queue_size, 1u)) {}
    message_filters::Subscriber<sensor_msgs::Image> images;
    message_filters::Subscriber<sensor_msgs::CameraInfo> infos;
    message_filters::TimeSynchronizer<sensor_msgs::Image, sensor_msgs::CameraInfo> sync;
  };
  boost::shared_ptr<Impl> impl_;
};

}  // namespace image_transport
