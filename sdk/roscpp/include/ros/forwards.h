#pragma once

#ifndef BOOST_BIND_GLOBAL_PLACEHOLDERS
#define BOOST_BIND_GLOBAL_PLACEHOLDERS  // for programs that write boost::bind(&f, _1)
#endif
#include <boost/bind.hpp>
#include <boost/function.hpp>
#include <boost/make_shared.hpp>
#include <boost/shared_ptr.hpp>
#include <boost/weak_ptr.hpp>
#include <list>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "ros/datatypes.h"
#include "ros/exceptions.h"
#include "ros/macros.h"
#include "ros/time.h"

namespace ros {

typedef boost::shared_ptr<void> VoidPtr;
typedef boost::weak_ptr<void> VoidWPtr;
typedef boost::shared_ptr<void const> VoidConstPtr;
typedef boost::weak_ptr<void const> VoidConstWPtr;

class CallbackQueue;
class CallbackQueueInterface;
class CallbackInterface;
typedef boost::shared_ptr<CallbackInterface> CallbackInterfacePtr;
class NodeHandle;
typedef boost::shared_ptr<NodeHandle> NodeHandlePtr;
class SingleSubscriberPublisher;
class SubscriptionCallbackHelper;
typedef boost::shared_ptr<SubscriptionCallbackHelper> SubscriptionCallbackHelperPtr;

typedef boost::function<void(const SingleSubscriberPublisher&)> SubscriberStatusCallback;

/** Times of a timer's callback. */
struct TimerEvent {
  Time last_expected, last_real, current_expected, current_real, last_expired, current_expired;
  struct {
    WallDuration last_duration;
  } profile;
};
struct WallTimerEvent {
  WallTime last_expected, last_real, current_expected, current_real, last_expired, current_expired;
  struct {
    WallDuration last_duration;
  } profile;
};
struct SteadyTimerEvent {
  SteadyTime last_expected, last_real, current_expected, current_real, last_expired, current_expired;
  struct {
    WallDuration last_duration;
  } profile;
};
typedef boost::function<void(const TimerEvent&)> TimerCallback;
typedef boost::function<void(const WallTimerEvent&)> WallTimerCallback;
typedef boost::function<void(const SteadyTimerEvent&)> SteadyTimerCallback;

}  // namespace ros
