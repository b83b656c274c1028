#pragma once

#include <image_transport/simple_subscriber_plugin.h>
#include <sensor_msgs/CompressedImage.h>

namespace compressed_image_transport {

/** Receives images as JPEG or PNG. */
class CompressedSubscriber : public image_transport::SimpleSubscriberPlugin<sensor_msgs::CompressedImage> {
 public:
  std::string getTransportName() const override { return "compressed"; }

 protected:
  void internalCallback(const sensor_msgs::CompressedImageConstPtr& message, const Callback& user_cb) override;
};

}  // namespace compressed_image_transport
