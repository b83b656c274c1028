#include "ros/rate.h"

namespace ros {
namespace {

/** Sleep until the end of the cycle; after one that took longer than two, the cycles start again from now. */
template <class TimeType, class DurationType>
bool finishCycle(TimeType& start, const DurationType& expected, DurationType& actual) {
  const TimeType now = TimeType::now();
  TimeType end = start + expected;
  if (now < start) end = now + expected;  // the time jumped back
  const DurationType rest = end - now;
  actual = now - start;
  start = end;
  if (rest > DurationType::ZERO) return rest.sleep();
  if (now > end + expected) start = now;
  return false;
}

}  // namespace

Rate::Rate(double frequency) : start_(Time::now()), expected_cycle_time_(1.0 / frequency) {}
Rate::Rate(const Duration& cycle) : start_(Time::now()), expected_cycle_time_(cycle) {}
bool Rate::sleep() { return finishCycle(start_, expected_cycle_time_, actual_cycle_time_); }
void Rate::reset() { start_ = Time::now(); }

WallRate::WallRate(double frequency) : start_(WallTime::now()), expected_cycle_time_(1.0 / frequency) {}
WallRate::WallRate(const Duration& cycle) : start_(WallTime::now()), expected_cycle_time_(cycle.sec, cycle.nsec) {}
bool WallRate::sleep() { return finishCycle(start_, expected_cycle_time_, actual_cycle_time_); }
void WallRate::reset() { start_ = WallTime::now(); }

}  // namespace ros
