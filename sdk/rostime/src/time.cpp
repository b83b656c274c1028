#include "ros/time.h"

#include <atomic>
#include <boost/date_time/posix_time/posix_time_types.hpp>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <iomanip>
#include <mutex>
#include <ostream>
#include <thread>

namespace ros {
namespace {

constexpr int64_t kSecond = 1000000000LL;
constexpr uint32_t kMaxSec = std::numeric_limits<uint32_t>::max();

/** Clock of this process; never destroyed, as threads may sleep while the process exits. */
struct Clock {
  std::mutex mutex;
  std::condition_variable changed;
  bool is_initialized = false, is_stopped = false;
  std::atomic<bool> is_simulated{false};
  Time now;
  void (*listener)() = nullptr;
};

Clock& clock() {
  static Clock* const instance = new Clock;
  return *instance;
}

template <class T>
void print(std::ostream& out, const T& value) {
  const std::streamsize width = out.width();
  const std::ios::fmtflags flags = out.flags();
  out << std::dec << value.sec << '.';
  const char fill = out.fill('0');
  out << std::setw(9) << value.nsec;
  out.fill(fill);
  out.flags(flags);
  out.width(width);
}

template <class T, class ChronoClock>
T read() {
  T now;
  const auto since = ChronoClock::now().time_since_epoch();
  now.fromNSec(static_cast<uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(since).count()));
  return now;
}

/** Wait in wall time; false if the process shut down meanwhile. */
bool sleepWall(const WallDuration& duration) {
  Clock& c = clock();
  std::unique_lock<std::mutex> lock(c.mutex);
  const auto end = std::chrono::steady_clock::now() + std::chrono::nanoseconds(duration.toNSec());
  while (!c.is_stopped)
    if (c.changed.wait_until(lock, end) == std::cv_status::timeout) return !c.is_stopped;
  return false;
}

}  // namespace

TimeNotInitializedException::TimeNotInitializedException()
    : Exception(
          "ros::Time::now() is called before a NodeHandle exists or ros::start() is called; a program without a "
          "node calls ros::Time::init() first") {}

void normalizeSecNSec(uint64_t& sec, uint64_t& nsec) {
  const uint64_t seconds = sec + nsec / kSecond;
  if (seconds > kMaxSec) throw std::runtime_error("Time is out of dual 32-bit range");
  sec = seconds;
  nsec %= kSecond;
}

void normalizeSecNSec(uint32_t& sec, uint32_t& nsec) {
  uint64_t seconds = sec, rest = nsec;
  normalizeSecNSec(seconds, rest);
  sec = static_cast<uint32_t>(seconds);
  nsec = static_cast<uint32_t>(rest);
}

void normalizeSecNSecUnsigned(int64_t& sec, int64_t& nsec) {
  uint32_t seconds = 0, rest = 0;
  impl::splitTime(sec * kSecond + nsec, seconds, rest);
  sec = seconds;
  nsec = rest;
}

namespace impl {

int64_t timeFromSec(double seconds) {
  const double whole = std::floor(seconds);
  if (!(whole >= 0 && whole <= kMaxSec)) throw std::runtime_error("Time is out of dual 32-bit range");
  return static_cast<int64_t>(whole) * kSecond + std::llround((seconds - whole) * 1e9);
}

void splitTime(int64_t total, uint32_t& sec, uint32_t& nsec) {
  if (total < 0 || total / kSecond > kMaxSec) throw std::runtime_error("Time is out of dual 32-bit range");
  sec = static_cast<uint32_t>(total / kSecond);
  nsec = static_cast<uint32_t>(total % kSecond);
}

void onTimeChange(void (*changed)()) { clock().listener = changed; }

}  // namespace impl

template <class T, class D>
boost::posix_time::ptime TimeBase<T, D>::toBoost() const {
  const boost::posix_time::ptime epoch(boost::gregorian::date(1970, 1, 1));
  return epoch + boost::posix_time::seconds(sec) + boost::posix_time::microseconds(nsec / 1000);
}
template class TimeBase<Time, Duration>;
template class TimeBase<WallTime, WallDuration>;
template class TimeBase<SteadyTime, WallDuration>;

Time Time::fromBoost(const boost::posix_time::ptime& t) {
  return fromBoost(t - boost::posix_time::ptime(boost::gregorian::date(1970, 1, 1)));
}

Time Time::fromBoost(const boost::posix_time::time_duration& d) {
  Time result;
  return result.fromNSec(static_cast<uint64_t>(d.total_microseconds()) * 1000);
}

Time Time::now() {
  Clock& c = clock();
  if (c.is_simulated) {
    const std::lock_guard<std::mutex> lock(c.mutex);
    return c.now;
  }
  if (!c.is_initialized) throw TimeNotInitializedException();
  return read<Time, std::chrono::system_clock>();
}

bool Time::sleepUntil(const Time& end) {
  Clock& c = clock();
  if (!c.is_simulated) {
    const Duration rest = end - now();
    return rest <= Duration::ZERO || sleepWall(WallDuration(rest.sec, rest.nsec));
  }
  std::unique_lock<std::mutex> lock(c.mutex);
  while (c.now.isZero() && !c.is_stopped) c.changed.wait(lock);
  Time last = c.now;
  while (!c.is_stopped) {
    if (c.now >= end) return true;
    if (c.now < last) return false;
    last = c.now;
    c.changed.wait(lock);
  }
  return false;
}

void Time::init() {
  Clock& c = clock();
  const std::lock_guard<std::mutex> lock(c.mutex);
  c.is_stopped = false;
  c.is_initialized = true;
  c.is_simulated = false;
}

void Time::shutdown() {
  Clock& c = clock();
  {
    const std::lock_guard<std::mutex> lock(c.mutex);
    c.is_stopped = true;
  }
  c.changed.notify_all();
}

void Time::setNow(const Time& now) {
  Clock& c = clock();
  {
    const std::lock_guard<std::mutex> lock(c.mutex);
    c.now = now;
    c.is_initialized = true;
    c.is_simulated = true;
  }
  c.changed.notify_all();
  if (c.listener) c.listener();
}

bool Time::useSystemTime() { return !clock().is_simulated; }
bool Time::isSimTime() { return clock().is_simulated; }
bool Time::isSystemTime() { return !clock().is_simulated; }

bool Time::isValid() {
  Clock& c = clock();
  const std::lock_guard<std::mutex> lock(c.mutex);
  return !c.is_simulated || !c.now.isZero();
}

bool Time::waitForValid() { return waitForValid(WallDuration()); }

bool Time::waitForValid(const WallDuration& timeout) {
  Clock& c = clock();
  const SteadyTime end = SteadyTime::now() + timeout;
  std::unique_lock<std::mutex> lock(c.mutex);
  while (!c.is_stopped && c.is_simulated && c.now.isZero()) {
    if (timeout.isZero()) {
      c.changed.wait(lock);
      continue;
    }
    const int64_t rest = (end - SteadyTime::now()).toNSec();
    if (rest <= 0) return false;
    c.changed.wait_for(lock, std::chrono::nanoseconds(rest));
  }
  return !c.is_stopped;
}

WallTime WallTime::now() { return read<WallTime, std::chrono::system_clock>(); }
SteadyTime SteadyTime::now() { return read<SteadyTime, std::chrono::steady_clock>(); }

bool WallTime::sleepUntil(const WallTime& end) {
  const WallDuration rest = end - now();
  return rest <= WallDuration::ZERO || sleepWall(rest);
}

bool SteadyTime::sleepUntil(const SteadyTime& end) {
  const WallDuration rest = end - now();
  return rest <= WallDuration::ZERO || sleepWall(rest);
}

bool Duration::sleep() const {
  if (!Time::isSimTime()) return *this <= ZERO || sleepWall(WallDuration(sec, nsec));
  Time::waitForValid();
  return *this <= ZERO || Time::sleepUntil(Time::now() + *this);
}

bool WallDuration::sleep() const { return *this <= ZERO || sleepWall(*this); }

std::ostream& operator<<(std::ostream& out, const Time& value) {
  print(out, value);
  return out;
}
std::ostream& operator<<(std::ostream& out, const WallTime& value) {
  print(out, value);
  return out;
}
std::ostream& operator<<(std::ostream& out, const SteadyTime& value) {
  print(out, value);
  return out;
}

#define ROS_TIME_CONSTANTS(Class)             \
  const Class Class::MAX(kMaxSec, 999999999); \
  const Class Class::MIN(0, 1);               \
  const Class Class::ZERO(0, 0);              \
  const Class Class::UNINITIALIZED(0, 0)
ROS_TIME_CONSTANTS(Time);
ROS_TIME_CONSTANTS(WallTime);
ROS_TIME_CONSTANTS(SteadyTime);
#undef ROS_TIME_CONSTANTS
const Time TIME_MAX(kMaxSec, 999999999), TIME_MIN(0, 1);

}  // namespace ros
