#pragma once

#include <string>

#include "message_filters/signal.h"

namespace message_filters {

/** Base of filters with one output. */
template <class M>
class SimpleFilter {
 public:
  typedef boost::shared_ptr<M const> MConstPtr;
  typedef boost::function<void(const MConstPtr&)> Callback;
  typedef ros::MessageEvent<M const> EventType;
  typedef boost::function<void(const EventType&)> EventCallback;

  SimpleFilter() {}
  SimpleFilter(const SimpleFilter&) = delete;
  SimpleFilter& operator=(const SimpleFilter&) = delete;

  template <typename C>
  Connection registerCallback(const C& callback) {
    return signal_.addCallback(callback);
  }
  /** With a parameter of the type that the caller names: what boost::bind() returns tells none. */
  template <typename P>
  Connection registerCallback(const boost::function<void(P)>& callback) {
    return signal_.addCallback(callback);
  }
  template <typename T, typename P>
  Connection registerCallback(void (T::*callback)(P), T* object) {
    return signal_.addCallback(callback, object);
  }
  void setName(const std::string& name) { name_ = name; }
  const std::string& getName() { return name_; }

 protected:
  void signalMessage(const MConstPtr& message) { signalMessage(EventType(message)); }
  void signalMessage(const EventType& event) { signal_.call(typename Signal<M>::Events(event)); }

 private:
  Signal<M> signal_;
  std::string name_;
};

}  // namespace message_filters
