#pragma once

#include "image_transport/simple_subscriber_plugin.h"

namespace image_transport {

/** Receives images as they are, on the base topic. */
class RawSubscriber : public SimpleSubscriberPlugin<sensor_msgs::Image> {
 public:
  std::string getTransportName() const override { return "raw"; }

 protected:
  void internalCallback(const sensor_msgs::ImageConstPtr& message, const Callback& user_cb) override {
    user_cb(message);
  }
  std::string getTopicToSubscribe(const std::string& base_topic) const override { return base_topic; }
};

}  // namespace image_transport
