#pragma once

#include "ros/common.h"
#include "ros/forwards.h"
#include "ros/timer_options.h"

namespace ros {

/** Handle of a timer; destroying the last copy stops the timer. */
class Timer {
 public:
  Timer() {}
  void start();
  /** Stop; a call that is still queued is dropped. */
  void stop();
  bool hasPending();
  void setPeriod(const Duration& period, bool reset = true);
  bool hasStarted() const;
  bool isValid() const;
  operator void*() const { return isValid() ? const_cast<Timer*>(this) : nullptr; }
  bool operator<(const Timer& other) const { return impl_ < other.impl_; }
  bool operator==(const Timer& other) const { return impl_ == other.impl_; }
  bool operator!=(const Timer& other) const { return impl_ != other.impl_; }

 private:
  friend class NodeHandle;
  explicit Timer(const TimerOptions& options);

  boost::shared_ptr<class TimerImpl> impl_;
};

}  // namespace ros
