#pragma once

#include "ros/common.h"
#include "ros/forwards.h"
#include "ros/steady_timer_options.h"

namespace ros {

/** Handle of a timer; destroying the last copy stops the timer. */
class SteadyTimer {
 public:
  SteadyTimer() {}
  void start();
  /** Stop; a call that is still queued is dropped. */
  void stop();
  bool hasPending();
  void setPeriod(const WallDuration& period, bool reset = true);
  bool hasStarted() const;
  bool isValid() const;
  operator void*() const { return isValid() ? const_cast<SteadyTimer*>(this) : nullptr; }
  bool operator<(const SteadyTimer& other) const { return impl_ < other.impl_; }
  bool operator==(const SteadyTimer& other) const { return impl_ == other.impl_; }
  bool operator!=(const SteadyTimer& other) const { return impl_ != other.impl_; }

 private:
  friend class NodeHandle;
  explicit SteadyTimer(const SteadyTimerOptions& options);

  boost::shared_ptr<class TimerImpl> impl_;
};

}  // namespace ros
