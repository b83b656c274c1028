#pragma once

#include <image_transport/simple_publisher_plugin.h>
#include <sensor_msgs/CompressedImage.h>

namespace compressed_image_transport {

/** Publishes images as JPEG or PNG, by the parameters TOPIC/compressed/format, jpeg_quality and png_level. */
class CompressedPublisher : public image_transport::SimplePublisherPlugin<sensor_msgs::CompressedImage> {
 public:
  std::string getTransportName() const override { return "compressed"; }

 protected:
  using image_transport::SimplePublisherPlugin<sensor_msgs::CompressedImage>::publish;
  void publish(const sensor_msgs::Image& message, const PublishFn& publish_fn) const override;
};

}  // namespace compressed_image_transport
