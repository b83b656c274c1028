#pragma once

#include <stdint.h>

#include <climits>
#include <cmath>
#include <iostream>  // included by the original, too: programs print without including it
#include <string>

#include "ros/duration.h"
#include "ros/exception.h"
#include "ros/macros.h"

namespace boost {
namespace posix_time {
class ptime;
}
}  // namespace boost

namespace ros {

/** Thrown if the time is read before ros::start() or ros::Time::init(). */
class TimeNotInitializedException : public Exception {
 public:
  TimeNotInitializedException();
};

void normalizeSecNSec(uint64_t& sec, uint64_t& nsec);
void normalizeSecNSec(uint32_t& sec, uint32_t& nsec);
void normalizeSecNSecUnsigned(int64_t& sec, int64_t& nsec);

namespace impl {
int64_t timeFromSec(double seconds);
void splitTime(int64_t total, uint32_t& sec, uint32_t& nsec);
}  // namespace impl

/** Point in time since 1970, or since the clock's start: seconds and nanoseconds in [0, 1e9). */
template <class T, class D>
class TimeBase {
 public:
  uint32_t sec, nsec;

  TimeBase() : sec(0), nsec(0) {}
  TimeBase(uint32_t s, uint32_t n) : sec(s), nsec(n) { normalizeSecNSec(sec, nsec); }
  explicit TimeBase(double t) { fromSec(t); }

  D operator-(const T& o) const {
    D result;
    result.fromNSec(total() - o.total());
    return result;
  }
  T operator+(const D& o) const { return at(total() + o.toNSec()); }
  T operator-(const D& o) const { return *this + -o; }
  T& operator+=(const D& o) { return self() = *this + o; }
  T& operator-=(const D& o) { return self() = *this - o; }
  bool operator==(const T& o) const { return sec == o.sec && nsec == o.nsec; }
  bool operator!=(const T& o) const { return !(*this == o); }
  bool operator<(const T& o) const { return total() < o.total(); }
  bool operator>(const T& o) const { return total() > o.total(); }
  bool operator<=(const T& o) const { return total() <= o.total(); }
  bool operator>=(const T& o) const { return total() >= o.total(); }

  double toSec() const { return static_cast<double>(sec) + 1e-9 * static_cast<double>(nsec); }
  T& fromSec(double t) { return set(impl::timeFromSec(t)); }
  uint64_t toNSec() const { return static_cast<uint64_t>(total()); }
  T& fromNSec(uint64_t t) { return set(static_cast<int64_t>(t)); }
  bool isZero() const { return sec == 0 && nsec == 0; }
  bool is_zero() const { return isZero(); }
  boost::posix_time::ptime toBoost() const;

 private:
  template <class, class>
  friend class TimeBase;
  int64_t total() const { return static_cast<int64_t>(sec) * 1000000000LL + static_cast<int64_t>(nsec); }
  T& self() { return *static_cast<T*>(this); }
  T& set(int64_t t) {
    impl::splitTime(t, sec, nsec);
    return self();
  }
  static T at(int64_t t) {
    T result;
    result.set(t);
    return result;
  }
};

/** ROS time: simulated time if /use_sim_time is true, else wall time. */
class Time : public TimeBase<Time, Duration> {
 public:
  Time() {}
  Time(uint32_t s, uint32_t n) : TimeBase<Time, Duration>(s, n) {}
  explicit Time(double t) { fromSec(t); }

  static Time now();
  static bool sleepUntil(const Time& end);
  static void init();
  static void shutdown();
  /** Set the simulated time, and wake up sleeping threads. */
  static void setNow(const Time& now);
  static bool useSystemTime();
  static bool isSimTime();
  static bool isSystemTime();
  static bool isValid();
  static bool waitForValid();
  static bool waitForValid(const class WallDuration& timeout);
  static Time fromBoost(const boost::posix_time::ptime& t);
  static Time fromBoost(const boost::posix_time::time_duration& d);

  static const Time MAX, MIN, ZERO, UNINITIALIZED;
};

/** Wall time, also in a simulation. */
class WallTime : public TimeBase<WallTime, WallDuration> {
 public:
  WallTime() {}
  WallTime(uint32_t s, uint32_t n) : TimeBase<WallTime, WallDuration>(s, n) {}
  explicit WallTime(double t) { fromSec(t); }
  static WallTime now();
  static bool sleepUntil(const WallTime& end);
  static bool isSystemTime() { return true; }

  static const WallTime MAX, MIN, ZERO, UNINITIALIZED;
};

/** Time of the steady clock, which is never set. */
class SteadyTime : public TimeBase<SteadyTime, WallDuration> {
 public:
  SteadyTime() {}
  SteadyTime(uint32_t s, uint32_t n) : TimeBase<SteadyTime, WallDuration>(s, n) {}
  explicit SteadyTime(double t) { fromSec(t); }
  static SteadyTime now();
  static bool sleepUntil(const SteadyTime& end);
  static bool isSystemTime() { return true; }

  static const SteadyTime MAX, MIN, ZERO, UNINITIALIZED;
};

extern const Duration DURATION_MAX, DURATION_MIN;
extern const Time TIME_MAX, TIME_MIN;

std::ostream& operator<<(std::ostream& out, const Time& value);
std::ostream& operator<<(std::ostream& out, const WallTime& value);
std::ostream& operator<<(std::ostream& out, const SteadyTime& value);

namespace impl {
/** Calls `changed` after each change of the simulated time; an internal interface of the kit. */
void onTimeChange(void (*changed)());
}  // namespace impl

}  // namespace ros
