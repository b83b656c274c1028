#pragma once

#include <cassert>
#include <functional>

#include "ros/common.h"
#include "ros/forwards.h"
#include "ros/message.h"
#include "ros/serialization.h"

namespace ros {

/** Handle of an advertised topic; destroying the last copy unadvertises it. */
class Publisher {
 public:
  Publisher() {}

  /** Publish a message. Subscribers in this process get the same object: do not change it afterwards. */
  template <typename M>
  void publish(const boost::shared_ptr<M>& message) const {
    if (!message || !accepts(message_traits::md5sum(*message), message_traits::datatype(*message))) return;
    SerializedMessage m;
    m.type_info = &typeid(M);
    m.message = message;
    publish([&message]() { return serialization::serializeMessage(*message); }, m);
  }
  template <typename M>
  void publish(const M& message) const {
    if (!accepts(message_traits::md5sum(message), message_traits::datatype(message))) return;
    SerializedMessage m;
    publish([&message]() { return serialization::serializeMessage(message); }, m);
  }
  void shutdown();
  std::string getTopic() const;
  uint32_t getNumSubscribers() const;
  bool isLatched() const;
  operator void*() const { return isValid() ? const_cast<Publisher*>(this) : nullptr; }
  bool operator<(const Publisher& other) const { return impl_ < other.impl_; }
  bool operator==(const Publisher& other) const { return impl_ == other.impl_; }
  bool operator!=(const Publisher& other) const { return impl_ != other.impl_; }

 private:
  friend class NodeHandle;
  struct Impl;
  explicit Publisher(const boost::shared_ptr<Impl>& impl) : impl_(impl) {}
  bool isValid() const;
  /** True if messages of a type may be published; logs the reason otherwise. */
  bool accepts(const char* md5sum, const char* datatype) const;
  void publish(const std::function<SerializedMessage()>& serialize, SerializedMessage& message) const;

  boost::shared_ptr<Impl> impl_;
};
typedef std::vector<Publisher> V_Publisher;

}  // namespace ros
