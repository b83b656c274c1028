#pragma once

#include <ros/publisher.h>

#include "image_transport/publisher_plugin.h"

namespace image_transport {

/** Base of the plugins that publish each image as one message of type M, on the topic BASE/TRANSPORT. */
template <class M>
class SimplePublisherPlugin : public PublisherPlugin {
 public:
  ~SimplePublisherPlugin() override {}
  uint32_t getNumSubscribers() const override { return publisher_.getNumSubscribers(); }
  std::string getTopic() const override { return publisher_.getTopic(); }
  void publish(const sensor_msgs::Image& message) const override {
    if (!publisher_) return;
    const ros::Publisher publisher = publisher_;
    publish(message, PublishFn([publisher](const M& encoded) { publisher.publish(encoded); }));
  }
  using PublisherPlugin::publish;
  void shutdown() override { publisher_.shutdown(); }

 protected:
  typedef boost::function<void(const M&)> PublishFn;

  /** Encode an image, and pass the message on. */
  virtual void publish(const sensor_msgs::Image& message, const PublishFn& publish_fn) const = 0;
  virtual std::string getTopicToAdvertise(const std::string& base_topic) const {
    return base_topic + "/" + getTransportName();
  }
  virtual void connectCallback(const ros::SingleSubscriberPublisher&) {}
  virtual void disconnectCallback(const ros::SingleSubscriberPublisher&) {}
  /** Handle of the transport's parameters. */
  const ros::NodeHandle& nh() const { return node_; }
  const ros::Publisher& getPublisher() const { return publisher_; }

  void advertiseImpl(ros::NodeHandle& nh, const std::string& base_topic, uint32_t queue_size,
                     const SubscriberStatusCallback& connect_cb, const SubscriberStatusCallback& disconnect_cb,
                     const ros::VoidPtr& tracked_object, bool latch) override {
    const std::string topic = getTopicToAdvertise(base_topic);
    node_ = ros::NodeHandle(nh, topic);
    publisher_ =
        nh.advertise<M>(topic, queue_size, adapted(connect_cb, &SimplePublisherPlugin::connectCallback),
                        adapted(disconnect_cb, &SimplePublisherPlugin::disconnectCallback), tracked_object, latch);
  }

 private:
  typedef void (SimplePublisherPlugin::*Own)(const ros::SingleSubscriberPublisher&);

  ros::SubscriberStatusCallback adapted(const SubscriberStatusCallback& user, Own own) {
    return [this, user, own](const ros::SingleSubscriberPublisher& peer) {
      (this->*own)(peer);
      if (!user) return;
      const ros::SingleSubscriberPublisher* const to = &peer;
      user(SingleSubscriberPublisher(
          peer.getSubscriberName(), getTopic(), [this] { return getNumSubscribers(); },
          [this, to](const sensor_msgs::Image& image) {
            publish(image, PublishFn([to](const M& encoded) { to->publish(encoded); }));
          }));
    };
  }

  ros::NodeHandle node_;
  ros::Publisher publisher_;
};

}  // namespace image_transport
