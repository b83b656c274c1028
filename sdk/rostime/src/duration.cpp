#include "ros/duration.h"

#include <boost/date_time/posix_time/posix_time_types.hpp>
#include <cmath>
#include <iomanip>
#include <ostream>

#include "ros/rate.h"

namespace ros {
namespace {

constexpr int64_t kSecond = 1000000000LL;
constexpr int32_t kMaxSec = std::numeric_limits<int32_t>::max(), kMinSec = std::numeric_limits<int32_t>::min();
constexpr int32_t kMaxNSec = 999999999;

void print(std::ostream& out, int64_t total, int32_t sec) {
  const std::streamsize width = out.width();
  const std::ios::fmtflags flags = out.flags();
  // The sign is that of the whole value: -0.5 s is sec -1, nsec 500000000.
  const bool is_negative = total < 0 && sec < 0;
  if (is_negative) {
    out << '-';
    total = -total;
  }
  out << std::dec << total / kSecond << '.';
  const char fill = out.fill('0');
  out << std::setw(9) << total % kSecond;
  out.fill(fill);
  out.flags(flags);
  out.width(width);
}

}  // namespace

void normalizeSecNSecSigned(int64_t& sec, int64_t& nsec) {
  int64_t seconds = sec + nsec / kSecond, rest = nsec % kSecond;
  if (rest < 0) {
    rest += kSecond;
    --seconds;
  }
  if (seconds < kMinSec || seconds > kMaxSec) throw std::runtime_error("Duration is out of dual 32-bit range");
  sec = seconds;
  nsec = rest;
}

void normalizeSecNSecSigned(int32_t& sec, int32_t& nsec) {
  int64_t seconds = sec, rest = nsec;
  normalizeSecNSecSigned(seconds, rest);
  sec = static_cast<int32_t>(seconds);
  nsec = static_cast<int32_t>(rest);
}

namespace impl {

int64_t durationFromSec(double seconds) {
  const double whole = std::floor(seconds);
  if (!(whole >= kMinSec && whole <= kMaxSec)) throw std::runtime_error("Duration is out of dual 32-bit range");
  return static_cast<int64_t>(whole) * kSecond + std::llround((seconds - whole) * 1e9);
}

void splitDuration(int64_t total, int32_t& sec, int32_t& nsec) {
  int64_t seconds = 0, rest = total;
  normalizeSecNSecSigned(seconds, rest);
  sec = static_cast<int32_t>(seconds);
  nsec = static_cast<int32_t>(rest);
}

int64_t scaled(int64_t total, double factor) { return durationFromSec(static_cast<double>(total) * 1e-9 * factor); }

}  // namespace impl

template <class T>
boost::posix_time::time_duration DurationBase<T>::toBoost() const {
  return boost::posix_time::seconds(sec) + boost::posix_time::microseconds(nsec / 1000);
}
template class DurationBase<Duration>;
template class DurationBase<WallDuration>;

Duration::Duration(const Rate& rate) : Duration(rate.expectedCycleTime()) {}
WallDuration::WallDuration(const Rate& rate)
    : WallDuration(rate.expectedCycleTime().sec, rate.expectedCycleTime().nsec) {}

std::ostream& operator<<(std::ostream& out, const Duration& value) {
  print(out, value.toNSec(), value.sec);
  return out;
}
std::ostream& operator<<(std::ostream& out, const WallDuration& value) {
  print(out, value.toNSec(), value.sec);
  return out;
}

// Constants, by one macro for the classes of both clocks.
#define ROS_DURATION_CONSTANTS(Class)         \
  const Class Class::MAX(kMaxSec, kMaxNSec);  \
  const Class Class::MIN(kMinSec, 0);         \
  const Class Class::ZERO(0, 0);              \
  const Class Class::DAY(60 * 60 * 24, 0);    \
  const Class Class::HOUR(60 * 60, 0);        \
  const Class Class::MINUTE(60, 0);           \
  const Class Class::SECOND(1, 0);            \
  const Class Class::MILLISECOND(0, 1000000); \
  const Class Class::MICROSECOND(0, 1000);    \
  const Class Class::NANOSECOND(0, 1)
ROS_DURATION_CONSTANTS(Duration);
ROS_DURATION_CONSTANTS(WallDuration);
#undef ROS_DURATION_CONSTANTS
const Duration DURATION_MAX(kMaxSec, kMaxNSec), DURATION_MIN(kMinSec, 0);

}  // namespace ros
