#pragma once

#include <message_filters/simple_filter.h>

#include "image_transport/image_transport.h"

namespace image_transport {

/** Filter whose messages are the images of a topic. */
class SubscriberFilter : public message_filters::SimpleFilter<sensor_msgs::Image> {
 public:
  SubscriberFilter() {}
  SubscriberFilter(ImageTransport& it, const std::string& base_topic, uint32_t queue_size,
                   const TransportHints& transport_hints = TransportHints()) {
    subscribe(it, base_topic, queue_size, transport_hints);
  }
  ~SubscriberFilter() { unsubscribe(); }
  void subscribe(ImageTransport& it, const std::string& base_topic, uint32_t queue_size,
                 const TransportHints& transport_hints = TransportHints()) {
    unsubscribe();
    subscriber_ = it.subscribe(base_topic, queue_size, &SubscriberFilter::pass, this, transport_hints);
  }
  void unsubscribe() { subscriber_.shutdown(); }
  std::string getTopic() const { return subscriber_.getTopic(); }
  uint32_t getNumPublishers() const { return subscriber_.getNumPublishers(); }
  std::string getTransport() const { return subscriber_.getTransport(); }
  const Subscriber& getSubscriber() const { return subscriber_; }

 private:
  void pass(const sensor_msgs::ImageConstPtr& image) { signalMessage(image); }
  Subscriber subscriber_;
};

}  // namespace image_transport
