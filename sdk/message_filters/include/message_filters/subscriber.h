#pragma once

#include <ros/ros.h>

#include "message_filters/simple_filter.h"

namespace message_filters {

class SubscriberBase {
 public:
  virtual ~SubscriberBase() {}
  virtual void subscribe(ros::NodeHandle& nh, const std::string& topic, uint32_t queue_size,
                         const ros::TransportHints& transport_hints = ros::TransportHints(),
                         ros::CallbackQueueInterface* callback_queue = nullptr) = 0;
  /** Subscribe again as before. */
  virtual void subscribe() = 0;
  virtual void unsubscribe() = 0;
};
typedef boost::shared_ptr<SubscriberBase> SubscriberBasePtr;

/** Filter whose messages are those of a topic. */
template <class M>
class Subscriber : public SubscriberBase, public SimpleFilter<M> {
 public:
  typedef ros::MessageEvent<M const> EventType;

  Subscriber() {}
  Subscriber(ros::NodeHandle& nh, const std::string& topic, uint32_t queue_size,
             const ros::TransportHints& transport_hints = ros::TransportHints(),
             ros::CallbackQueueInterface* callback_queue = nullptr) {
    subscribe(nh, topic, queue_size, transport_hints, callback_queue);
  }
  ~Subscriber() { unsubscribe(); }

  void subscribe(ros::NodeHandle& nh, const std::string& topic, uint32_t queue_size,
                 const ros::TransportHints& transport_hints = ros::TransportHints(),
                 ros::CallbackQueueInterface* callback_queue = nullptr) override {
    unsubscribe();
    if (topic.empty()) return;
    options_ = ros::SubscribeOptions();
    options_.template initByFullCallbackType<const EventType&>(topic, queue_size,
                                                               [this](const EventType& event) { cb(event); });
    options_.callback_queue = callback_queue;
    options_.transport_hints = transport_hints;
    nh_ = nh;
    subscriber_ = nh_.subscribe(options_);
  }
  void subscribe() override {
    unsubscribe();
    if (!options_.topic.empty()) subscriber_ = nh_.subscribe(options_);
  }
  void unsubscribe() override { subscriber_.shutdown(); }
  std::string getTopic() const { return subscriber_.getTopic(); }
  const ros::Subscriber& getSubscriber() const { return subscriber_; }

  /** Without effect, as a topic is its only input; for Chain. */
  template <typename F>
  void connectInput(F&) {}
  void add(const EventType&) {}

 private:
  void cb(const EventType& event) { this->signalMessage(event); }

  ros::Subscriber subscriber_;
  ros::SubscribeOptions options_;
  ros::NodeHandle nh_;
};

}  // namespace message_filters
