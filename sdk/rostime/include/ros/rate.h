#pragma once

#include "ros/duration.h"
#include "ros/time.h"

namespace ros {

/** Sleeps for the rest of each cycle of a loop, in ROS time. */
class Rate {
 public:
  explicit Rate(double frequency);
  explicit Rate(const Duration& cycle);
  bool sleep();
  void reset();
  Duration cycleTime() const { return actual_cycle_time_; }
  Duration expectedCycleTime() const { return expected_cycle_time_; }

 private:
  Time start_;
  Duration expected_cycle_time_, actual_cycle_time_;
};

/** Sleeps for the rest of each cycle of a loop, in wall time. */
class WallRate {
 public:
  explicit WallRate(double frequency);
  explicit WallRate(const Duration& cycle);
  bool sleep();
  void reset();
  WallDuration cycleTime() const { return actual_cycle_time_; }
  WallDuration expectedCycleTime() const { return expected_cycle_time_; }

 private:
  WallTime start_;
  WallDuration expected_cycle_time_, actual_cycle_time_;
};

}  // namespace ros
