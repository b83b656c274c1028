#pragma once

#include <ros/subscriber.h>
#include <sensor_msgs/Image.h>

#include "image_transport/exception.h"
#include "image_transport/transport_hints.h"

namespace image_transport {

/** Subscription of images. */
class Subscriber {
 public:
  Subscriber() {}
  std::string getTopic() const { return subscriber_.getTopic(); }
  uint32_t getNumPublishers() const { return subscriber_.getNumPublishers(); }
  std::string getTransport() const { return "raw"; }
  void shutdown() { subscriber_.shutdown(); }
  operator void*() const { return subscriber_; }
  bool operator<(const Subscriber& other) const { return subscriber_ < other.subscriber_; }
  bool operator==(const Subscriber& other) const { return subscriber_ == other.subscriber_; }
  bool operator!=(const Subscriber& other) const { return !(*this == other); }

 private:
  friend class ImageTransport;
  explicit Subscriber(const ros::Subscriber& subscriber) : subscriber_(subscriber) {}
  ros::Subscriber subscriber_;
};

/** Throw TransportLoadException unless a subscriber wants raw images. */
inline void requireRaw(const TransportHints& hints) {
  if (hints.getTransport() != "raw")
    throw TransportLoadException(hints.getTransport(),
                                 "Trundle's development kit has raw images alone: set ~image_transport to raw");
}

}  // namespace image_transport
