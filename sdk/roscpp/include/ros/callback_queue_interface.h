#pragma once

#include <stdint.h>

#include <boost/shared_ptr.hpp>

#include "ros/common.h"
#include "ros/types.h"

namespace ros {

/** A call that waits in a queue. */
class CallbackInterface {
 public:
  enum CallResult {
    Success,
    /** The call cannot run now, and stays in the queue. */
    TryAgain,
    Invalid,
  };
  virtual ~CallbackInterface() {}
  virtual CallResult call() = 0;
  virtual bool ready() { return true; }
};
typedef boost::shared_ptr<CallbackInterface> CallbackInterfacePtr;

class ROSCPP_DECL CallbackQueueInterface {
 public:
  CallbackQueueInterface();
  virtual ~CallbackQueueInterface();
  /** False of null, and of a queue that was destroyed: a plugin may destroy its own before the subscribers to it. */
  static bool exists(const CallbackQueueInterface* queue);
  virtual void addCallback(const CallbackInterfacePtr& callback, uint64_t owner_id = 0) = 0;
  /** Remove an owner's calls, and wait for a call that is running in another thread. */
  virtual void removeByID(uint64_t owner_id) = 0;
};

}  // namespace ros
