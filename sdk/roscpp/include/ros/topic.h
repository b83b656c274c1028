#pragma once

#include <boost/shared_ptr.hpp>

#include "ros/common.h"
#include "ros/node_handle.h"

namespace ros {
namespace topic {

/** Subscribe with the options and a separate queue, and wait until `received` is true. */
void waitForMessageImpl(SubscribeOptions& options, const boost::function<bool()>& received, NodeHandle& handle,
                        ros::Duration timeout);

template <class M>
class SubscribeHelper {
 public:
  typedef boost::shared_ptr<M const> MConstPtr;
  void callback(const MConstPtr& message) { message_ = message; }
  bool hasMessage() { return static_cast<bool>(message_); }
  MConstPtr getMessage() { return message_; }

 private:
  MConstPtr message_;
};

/** Wait for one message of a topic; null at the timeout, or if the node shuts down. A timeout of 0 s means no limit. */
template <class M>
boost::shared_ptr<M const> waitForMessage(const std::string& topic, NodeHandle& handle, ros::Duration timeout) {
  SubscribeHelper<M> helper;
  SubscribeOptions options;
  options.template init<M>(topic, 1, boost::bind(&SubscribeHelper<M>::callback, &helper, _1));
  waitForMessageImpl(options, boost::bind(&SubscribeHelper<M>::hasMessage, &helper), handle, timeout);
  return helper.getMessage();
}
template <class M>
boost::shared_ptr<M const> waitForMessage(const std::string& topic) {
  NodeHandle handle;
  return waitForMessage<M>(topic, handle, ros::Duration());
}
template <class M>
boost::shared_ptr<M const> waitForMessage(const std::string& topic, ros::Duration timeout) {
  NodeHandle handle;
  return waitForMessage<M>(topic, handle, timeout);
}
template <class M>
boost::shared_ptr<M const> waitForMessage(const std::string& topic, NodeHandle& handle) {
  return waitForMessage<M>(topic, handle, ros::Duration());
}

}  // namespace topic
}  // namespace ros
