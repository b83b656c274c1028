#include "image_transport/publisher.h"

#include <ros/console.h>

#include <algorithm>

#include "image_transport/exception.h"
#include "transports.h"

namespace image_transport {

struct Publisher::Impl {
  ~Impl() { shutdown(); }
  void shutdown() {
    for (const boost::shared_ptr<PublisherPlugin>& plugin : plugins) plugin->shutdown();
    plugins.clear();
  }
  std::string base_topic;
  std::vector<boost::shared_ptr<PublisherPlugin> > plugins;
};

Publisher::Publisher(ros::NodeHandle& nh, const std::string& base_topic, uint32_t queue_size,
                     const SubscriberStatusCallback& connect_cb, const SubscriberStatusCallback& disconnect_cb,
                     const ros::VoidPtr& tracked_object, bool latch)
    : impl_(boost::make_shared<Impl>()) {
  impl_->base_topic = nh.resolveName(base_topic);
  std::vector<std::string> left_out;
  nh.getParam(impl_->base_topic + "/disable_pub_plugins", left_out);
  for (const std::string& name : publisherTransports()) {
    if (std::find(left_out.begin(), left_out.end(), "image_transport/" + name) != left_out.end()) continue;
    try {
      const boost::shared_ptr<PublisherPlugin> plugin = createPublisher(name);
      plugin->advertise(nh, impl_->base_topic, queue_size, connect_cb, disconnect_cb, tracked_object, latch);
      impl_->plugins.push_back(plugin);
    } catch (const TransportLoadException& error) {
      ROS_WARN("%s is not published by %s: %s", base_topic.c_str(), name.c_str(), error.what());
    }
  }
}

uint32_t Publisher::getNumSubscribers() const {
  uint32_t count = 0;
  if (impl_)
    for (const boost::shared_ptr<PublisherPlugin>& plugin : impl_->plugins) count += plugin->getNumSubscribers();
  return count;
}

std::string Publisher::getTopic() const { return impl_ ? impl_->base_topic : ""; }

void Publisher::publish(const sensor_msgs::Image& message) const {
  if (!impl_) return;
  // A transport that latches keeps the last image for subscribers to come.
  for (const boost::shared_ptr<PublisherPlugin>& plugin : impl_->plugins)
    if (plugin->getNumSubscribers() > 0 || plugin->getTransportName() == "raw") plugin->publish(message);
}

void Publisher::publish(const sensor_msgs::ImageConstPtr& message) const {
  if (!impl_) return;
  for (const boost::shared_ptr<PublisherPlugin>& plugin : impl_->plugins)
    if (plugin->getNumSubscribers() > 0 || plugin->getTransportName() == "raw") plugin->publish(message);
}

void Publisher::shutdown() {
  if (impl_) impl_->shutdown();
}

Publisher::operator void*() const { return impl_ && !impl_->plugins.empty() ? impl_.get() : nullptr; }

}  // namespace image_transport
