#include "image_transport/subscriber.h"

#include "transports.h"

namespace image_transport {

struct Subscriber::Impl {
  ~Impl() { plugin->shutdown(); }
  std::string base_topic;
  boost::shared_ptr<SubscriberPlugin> plugin;
  bool is_shut_down = false;
};

Subscriber::Subscriber(ros::NodeHandle& nh, const std::string& base_topic, uint32_t queue_size,
                       const boost::function<void(const sensor_msgs::ImageConstPtr&)>& callback,
                       const ros::VoidPtr& tracked_object, const TransportHints& transport_hints) {
  const boost::shared_ptr<SubscriberPlugin> plugin = createSubscriber(transport_hints.getTransport());
  impl_ = boost::make_shared<Impl>();
  impl_->plugin = plugin;
  impl_->base_topic = nh.resolveName(base_topic);
  plugin->subscribe(nh, impl_->base_topic, queue_size, callback, tracked_object, transport_hints);
}

std::string Subscriber::getTopic() const { return impl_ ? impl_->base_topic : ""; }
uint32_t Subscriber::getNumPublishers() const { return impl_ ? impl_->plugin->getNumPublishers() : 0; }
std::string Subscriber::getTransport() const { return impl_ ? impl_->plugin->getTransportName() : ""; }

void Subscriber::shutdown() {
  if (!impl_) return;
  impl_->plugin->shutdown();
  impl_->is_shut_down = true;
}

Subscriber::operator void*() const { return impl_ && !impl_->is_shut_down ? impl_.get() : nullptr; }

}  // namespace image_transport
