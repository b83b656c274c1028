#pragma once

#include <boost/noncopyable.hpp>
#include <functional>

#include "ros/forwards.h"
#include "ros/serialization.h"

namespace ros {

class SubscriberLink;
typedef boost::shared_ptr<SubscriberLink> SubscriberLinkPtr;

/** Publisher to one subscriber, for the callback about this subscriber's connection. */
class SingleSubscriberPublisher : public boost::noncopyable {
 public:
  explicit SingleSubscriberPublisher(const SubscriberLinkPtr& link) : link_(link) {}
  template <class M>
  void publish(const boost::shared_ptr<M const>& message) const {
    publish(*message);
  }
  template <class M>
  void publish(const boost::shared_ptr<M>& message) const {
    publish(*message);
  }
  template <class M>
  void publish(const M& message) const {
    send(serialization::serializeMessage(message));
  }
  std::string getTopic() const;
  std::string getSubscriberName() const;

 private:
  void send(const SerializedMessage& message) const;
  SubscriberLinkPtr link_;
};

}  // namespace ros
