#pragma once

#include "image_transport/simple_publisher_plugin.h"

namespace image_transport {

/** Publishes images as they are, on the base topic. */
class RawPublisher : public SimplePublisherPlugin<sensor_msgs::Image> {
 public:
  std::string getTransportName() const override { return "raw"; }
  using SimplePublisherPlugin<sensor_msgs::Image>::publish;
  void publish(const sensor_msgs::ImageConstPtr& message) const override { getPublisher().publish(message); }

 protected:
  void publish(const sensor_msgs::Image& message, const PublishFn& publish_fn) const override { publish_fn(message); }
  std::string getTopicToAdvertise(const std::string& base_topic) const override { return base_topic; }
};

}  // namespace image_transport
