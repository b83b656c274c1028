#pragma once

#include "ros/common.h"
#include "ros/forwards.h"
#include "ros/subscription_callback_helper.h"

namespace ros {

/** Handle of a subscription; destroying the last copy unsubscribes. */
class Subscriber {
 public:
  Subscriber() {}
  void shutdown();
  std::string getTopic() const;
  uint32_t getNumPublishers() const;
  operator void*() const { return isValid() ? const_cast<Subscriber*>(this) : nullptr; }
  bool operator<(const Subscriber& other) const { return impl_ < other.impl_; }
  bool operator==(const Subscriber& other) const { return impl_ == other.impl_; }
  bool operator!=(const Subscriber& other) const { return impl_ != other.impl_; }

 private:
  friend class NodeHandle;
  struct Impl;
  explicit Subscriber(const boost::shared_ptr<Impl>& impl) : impl_(impl) {}
  bool isValid() const;

  boost::shared_ptr<Impl> impl_;
};
typedef std::vector<Subscriber> V_Subscriber;

}  // namespace ros
