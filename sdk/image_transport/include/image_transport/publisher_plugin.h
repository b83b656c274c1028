#pragma once

#include <ros/node_handle.h>
#include <sensor_msgs/Image.h>

#include "image_transport/single_subscriber_publisher.h"

namespace image_transport {

/** Base of the plugins that publish images in a form of their own. */
class PublisherPlugin {
 public:
  PublisherPlugin() {}
  PublisherPlugin(const PublisherPlugin&) = delete;
  PublisherPlugin& operator=(const PublisherPlugin&) = delete;
  virtual ~PublisherPlugin() {}

  /** Name such as "compressed". */
  virtual std::string getTransportName() const = 0;
  void advertise(ros::NodeHandle& nh, const std::string& base_topic, uint32_t queue_size, bool latch = true) {
    advertiseImpl(nh, base_topic, queue_size, SubscriberStatusCallback(), SubscriberStatusCallback(), ros::VoidPtr(),
                  latch);
  }
  void advertise(ros::NodeHandle& nh, const std::string& base_topic, uint32_t queue_size,
                 const SubscriberStatusCallback& connect_cb,
                 const SubscriberStatusCallback& disconnect_cb = SubscriberStatusCallback(),
                 const ros::VoidPtr& tracked_object = ros::VoidPtr(), bool latch = true) {
    advertiseImpl(nh, base_topic, queue_size, connect_cb, disconnect_cb, tracked_object, latch);
  }
  virtual uint32_t getNumSubscribers() const = 0;
  /** Topic of this transport. */
  virtual std::string getTopic() const = 0;
  virtual void publish(const sensor_msgs::Image& message) const = 0;
  virtual void publish(const sensor_msgs::ImageConstPtr& message) const { publish(*message); }
  /** Publish an image whose pixels are elsewhere, step · height bytes. */
  virtual void publish(const sensor_msgs::Image& message, const uint8_t* data) const {
    sensor_msgs::Image image = message;
    image.data.assign(data, data + static_cast<size_t>(image.step) * image.height);
    publish(image);
  }
  virtual void shutdown() = 0;
  /** Name of a transport's plugin. */
  static std::string getLookupName(const std::string& transport_name) {
    return "image_transport/" + transport_name + "_pub";
  }

 protected:
  virtual void advertiseImpl(ros::NodeHandle& nh, const std::string& base_topic, uint32_t queue_size,
                             const SubscriberStatusCallback& connect_cb, const SubscriberStatusCallback& disconnect_cb,
                             const ros::VoidPtr& tracked_object, bool latch) = 0;
};

}  // namespace image_transport
