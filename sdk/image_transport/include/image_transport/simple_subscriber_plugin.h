#pragma once

#include <ros/subscriber.h>

#include "image_transport/subscriber_plugin.h"

namespace image_transport {

/** Base of the plugins that receive each image as one message of type M, on the topic BASE/TRANSPORT. */
template <class M>
class SimpleSubscriberPlugin : public SubscriberPlugin {
 public:
  ~SimpleSubscriberPlugin() override {}
  std::string getTopic() const override { return subscriber_.getTopic(); }
  uint32_t getNumPublishers() const override { return subscriber_.getNumPublishers(); }
  void shutdown() override { subscriber_.shutdown(); }

 protected:
  /** Decode a message, and call the user's function with the image. */
  virtual void internalCallback(const typename M::ConstPtr& message, const Callback& user_cb) = 0;
  virtual std::string getTopicToSubscribe(const std::string& base_topic) const {
    return base_topic + "/" + getTransportName();
  }
  /** Handle of the transport's parameters. */
  const ros::NodeHandle& nh() const { return node_; }

  void subscribeImpl(ros::NodeHandle& nh, const std::string& base_topic, uint32_t queue_size, const Callback& callback,
                     const ros::VoidPtr& tracked_object, const TransportHints& transport_hints) override {
    node_ = ros::NodeHandle(transport_hints.getParameterNH(), getTransportName());
    subscriber_ = nh.subscribe<M>(
        getTopicToSubscribe(base_topic), queue_size,
        boost::function<void(const typename M::ConstPtr&)>(
            [this, callback](const typename M::ConstPtr& message) { internalCallback(message, callback); }),
        tracked_object, transport_hints.getRosHints());
  }

 private:
  ros::NodeHandle node_;
  ros::Subscriber subscriber_;
};

}  // namespace image_transport
