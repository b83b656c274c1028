#pragma once

#include <stdint.h>

#include <iosfwd>
#include <limits>
#include <stdexcept>

namespace boost {
namespace posix_time {
class time_duration;
}
}  // namespace boost

namespace ros {

/** Splits nanoseconds into seconds and nanoseconds in [0, 1e9); throws std::runtime_error outside of 32 bits. */
void normalizeSecNSecSigned(int32_t& sec, int32_t& nsec);
void normalizeSecNSecSigned(int64_t& sec, int64_t& nsec);

namespace impl {
/** Convert seconds to nanoseconds; throws std::runtime_error if the number is NaN or outside of a duration's range. */
int64_t durationFromSec(double seconds);
/** Seconds and nanoseconds of a total [ns]; throws std::runtime_error outside of 32 bits. */
void splitDuration(int64_t total, int32_t& sec, int32_t& nsec);
int64_t scaled(int64_t total, double factor);
}  // namespace impl

/** Signed length of time: seconds and nanoseconds in [0, 1e9). */
template <class T>
class DurationBase {
 public:
  int32_t sec, nsec;

  DurationBase() : sec(0), nsec(0) {}
  DurationBase(int32_t s, int32_t n) : sec(s), nsec(n) { normalizeSecNSecSigned(sec, nsec); }
  explicit DurationBase(double t) { fromSec(t); }

  T operator+(const T& o) const { return ofNSec(toNSec() + o.toNSec()); }
  T operator-(const T& o) const { return ofNSec(toNSec() - o.toNSec()); }
  T operator-() const { return ofNSec(-toNSec()); }
  T operator*(double factor) const { return ofNSec(impl::scaled(toNSec(), factor)); }
  T operator/(double divisor) const { return *this * (1.0 / divisor); }
  T& operator+=(const T& o) { return self() = *this + o; }
  T& operator-=(const T& o) { return self() = *this - o; }
  T& operator*=(double factor) { return self() = *this * factor; }
  bool operator==(const T& o) const { return sec == o.sec && nsec == o.nsec; }
  bool operator!=(const T& o) const { return !(*this == o); }
  bool operator<(const T& o) const { return toNSec() < o.toNSec(); }
  bool operator>(const T& o) const { return toNSec() > o.toNSec(); }
  bool operator<=(const T& o) const { return toNSec() <= o.toNSec(); }
  bool operator>=(const T& o) const { return toNSec() >= o.toNSec(); }

  double toSec() const { return static_cast<double>(sec) + 1e-9 * static_cast<double>(nsec); }
  int64_t toNSec() const { return static_cast<int64_t>(sec) * 1000000000LL + static_cast<int64_t>(nsec); }
  T& fromSec(double t) { return fromNSec(impl::durationFromSec(t)); }
  T& fromNSec(int64_t t) {
    impl::splitDuration(t, sec, nsec);
    return self();
  }
  bool isZero() const { return sec == 0 && nsec == 0; }
  boost::posix_time::time_duration toBoost() const;

 private:
  T& self() { return *static_cast<T*>(this); }
  static T ofNSec(int64_t total) {
    T result;
    result.fromNSec(total);
    return result;
  }
};

/** Duration of ROS time. */
class Duration : public DurationBase<Duration> {
 public:
  Duration() {}
  Duration(int32_t s, int32_t n) : DurationBase<Duration>(s, n) {}
  explicit Duration(double t) { fromSec(t); }
  explicit Duration(const class Rate& rate);
  /** Sleep in ROS time; false if the node shut down or the time jumped back meanwhile. */
  bool sleep() const;

  static const Duration MAX, MIN, ZERO, DAY, HOUR, MINUTE, SECOND, MILLISECOND, MICROSECOND, NANOSECOND;
};

/** Duration of wall time. */
class WallDuration : public DurationBase<WallDuration> {
 public:
  WallDuration() {}
  WallDuration(int32_t s, int32_t n) : DurationBase<WallDuration>(s, n) {}
  explicit WallDuration(double t) { fromSec(t); }
  explicit WallDuration(const Rate& rate);
  bool sleep() const;

  static const WallDuration MAX, MIN, ZERO, DAY, HOUR, MINUTE, SECOND, MILLISECOND, MICROSECOND, NANOSECOND;
};

std::ostream& operator<<(std::ostream& out, const Duration& value);
std::ostream& operator<<(std::ostream& out, const WallDuration& value);

}  // namespace ros
