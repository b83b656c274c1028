#pragma once

#include "ros/common.h"
#include "ros/forwards.h"
#include "ros/wall_timer_options.h"

namespace ros {

/** Handle of a timer; destroying the last copy stops the timer. */
class WallTimer {
 public:
  WallTimer() {}
  void start();
  /** Stop; a call that is still queued is dropped. */
  void stop();
  bool hasPending();
  void setPeriod(const WallDuration& period, bool reset = true);
  bool hasStarted() const;
  bool isValid() const;
  operator void*() const { return isValid() ? const_cast<WallTimer*>(this) : nullptr; }
  bool operator<(const WallTimer& other) const { return impl_ < other.impl_; }
  bool operator==(const WallTimer& other) const { return impl_ == other.impl_; }
  bool operator!=(const WallTimer& other) const { return impl_ != other.impl_; }

 private:
  friend class NodeHandle;
  explicit WallTimer(const WallTimerOptions& options);

  boost::shared_ptr<class TimerImpl> impl_;
};

}  // namespace ros
