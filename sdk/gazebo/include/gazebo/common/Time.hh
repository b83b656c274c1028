// Time in seconds and nanoseconds.
#ifndef GAZEBO_COMMON_TIME_HH_
#define GAZEBO_COMMON_TIME_HH_

#include <time.h>

#include <cstdint>
#include <istream>
#include <ostream>
#include <string>

namespace gazebo {
namespace common {

class Time {
 public:
  static const Time Zero, Hour, Minute, Second;
  static const int32_t nsInSec = 1000000000;
  static const int32_t nsInMs = 1000000;

  Time() : sec(0), nsec(0) {}
  Time(const struct timespec& ts) : Time(ts.tv_sec, static_cast<int32_t>(ts.tv_nsec)) {}  // NOLINT: as the original
  Time(int32_t s, int32_t ns) { Normalize(s, ns); }
  Time(double seconds) { Set(seconds); }  // NOLINT: implicit as in the original

  static const Time& GetWallTime();
  static const std::string& GetWallTimeAsISOString();
  static Time FromNanoseconds(int64_t ns) {
    return Time(static_cast<int32_t>(ns / nsInSec), static_cast<int32_t>(ns % nsInSec));
  }
  void SetToWallTime() { *this = GetWallTime(); }
  void Set(int32_t s, int32_t ns) { Normalize(s, ns); }
  void Set(double seconds) {
    const int64_t s = static_cast<int64_t>(seconds);
    Normalize(s, static_cast<int64_t>((seconds - static_cast<double>(s)) * 1e9 + (seconds < 0 ? -0.5 : 0.5)));
  }
  double Double() const { return sec + nsec * 1e-9; }
  float Float() const { return static_cast<float>(Double()); }
  int64_t Nanoseconds() const { return int64_t(sec) * nsInSec + nsec; }
  std::string FormattedString() const;
  static Time Sleep(const Time& time);
  static Time MSleep(unsigned int ms) { return Sleep(Time(int32_t(ms / 1000), int32_t(ms % 1000) * nsInMs)); }
  static Time NSleep(unsigned int ns) { return Sleep(Time(int32_t(ns / nsInSec), int32_t(ns % nsInSec))); }
  static double SecToNano(double seconds) { return seconds * 1e9; }
  static double MilToNano(double ms) { return ms * 1e6; }
  static double MicToNano(double us) { return us * 1e3; }

  Time operator+(const Time& o) const { return Sum(int64_t(sec) + o.sec, int64_t(nsec) + o.nsec); }
  Time operator-(const Time& o) const { return Sum(int64_t(sec) - o.sec, int64_t(nsec) - o.nsec); }
  Time operator*(const Time& o) const { return Time(Double() * o.Double()); }
  Time operator/(const Time& o) const { return Time(Double() / o.Double()); }
  const Time& operator+=(const Time& o) { return *this = *this + o; }
  const Time& operator-=(const Time& o) { return *this = *this - o; }
  const Time& operator*=(const Time& o) { return *this = *this * o; }
  const Time& operator/=(const Time& o) { return *this = *this / o; }
  bool operator==(const Time& o) const { return sec == o.sec && nsec == o.nsec; }
  bool operator!=(const Time& o) const { return !(*this == o); }
  bool operator<(const Time& o) const { return sec < o.sec || (sec == o.sec && nsec < o.nsec); }
  bool operator>(const Time& o) const { return o < *this; }
  bool operator<=(const Time& o) const { return !(o < *this); }
  bool operator>=(const Time& o) const { return !(*this < o); }
  bool operator==(double o) const { return *this == Time(o); }
  bool operator!=(double o) const { return *this != Time(o); }
  bool operator<(double o) const { return *this < Time(o); }
  bool operator>(double o) const { return *this > Time(o); }
  bool operator<=(double o) const { return *this <= Time(o); }
  bool operator>=(double o) const { return *this >= Time(o); }
  friend std::ostream& operator<<(std::ostream& out, const Time& t) { return out << t.sec << ' ' << t.nsec; }
  friend std::istream& operator>>(std::istream& in, Time& t) { return in >> t.sec >> t.nsec; }

  int32_t sec;
  int32_t nsec;

 private:
  static Time Sum(int64_t s, int64_t ns) {
    Time result;
    result.Normalize(s, ns);
    return result;
  }
  void Normalize(int64_t s, int64_t ns) {
    s += ns / nsInSec;
    ns %= nsInSec;
    if (ns < 0 && s > 0) {
      ns += nsInSec;
      --s;
    } else if (ns > 0 && s < 0) {
      ns -= nsInSec;
      ++s;
    }
    sec = static_cast<int32_t>(s);
    nsec = static_cast<int32_t>(ns);
  }
};

}  // namespace common
}  // namespace gazebo

#endif
