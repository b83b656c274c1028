#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>

#include <gazebo/common/common.hh>

namespace gazebo {
namespace common {

namespace {

bool is_quiet = false;

std::ostream& nowhere() {
  static thread_local std::ostream stream(nullptr);
  return stream;
}

}  // namespace

const Time Time::Zero(0, 0), Time::Hour(3600, 0), Time::Minute(60, 0), Time::Second(1, 0);
const int32_t Time::nsInSec;
const int32_t Time::nsInMs;

const Time& Time::GetWallTime() {
  static thread_local Time now;
  struct timespec ts;
  clock_gettime(CLOCK_REALTIME, &ts);
  now = Time(ts);
  return now;
}

const std::string& Time::GetWallTimeAsISOString() {
  static thread_local std::string text;
  struct timespec ts;
  clock_gettime(CLOCK_REALTIME, &ts);
  struct tm parts;
  localtime_r(&ts.tv_sec, &parts);
  char date[32], whole[64];
  std::strftime(date, sizeof(date), "%Y-%m-%dT%H:%M:%S", &parts);
  std::snprintf(whole, sizeof(whole), "%s.%06ld", date, ts.tv_nsec / 1000);
  return text = whole;
}

std::string Time::FormattedString() const {
  const int64_t ms = Nanoseconds() / nsInMs;
  char text[48];
  std::snprintf(text, sizeof(text), "%02lld %02lld:%02lld:%02lld.%03lld", static_cast<long long>(ms / 86400000),
                static_cast<long long>(ms / 3600000 % 24), static_cast<long long>(ms / 60000 % 60),
                static_cast<long long>(ms / 1000 % 60), static_cast<long long>(ms % 1000));
  return text;
}

Time Time::Sleep(const Time& time) {
  struct timespec wanted = {time.sec, time.nsec}, left = {0, 0};
  return nanosleep(&wanted, &left) == 0 ? Time(0, 0) : Time(left);
}

void Console::SetQuiet(bool quiet) { is_quiet = quiet; }
bool Console::GetQuiet() { return is_quiet; }

std::ostream& Console::Stream(const char* kind, const char* file, unsigned int line) {
  if (!*kind) return nowhere();
  if (is_quiet && std::strcmp(kind, "Err") != 0 && std::strcmp(kind, "Wrn") != 0) return nowhere();
  std::ostream& out = std::strcmp(kind, "Msg") == 0 || std::strcmp(kind, "Dbg") == 0 ? std::cout : std::cerr;
  out << "[" << kind << "] ";
  if (file) {
    const char* base = std::strrchr(file, '/');
    out << "[" << (base ? base + 1 : file) << ":" << line << "] ";
  }
  return out;
}

void Exception::Print() const { std::cerr << "[Err] [" << file_ << ":" << line_ << "] " << text_ << std::endl; }

const Color Color::White(1, 1, 1, 1), Color::Black(0, 0, 0, 1), Color::Red(1, 0, 0, 1), Color::Green(0, 1, 0, 1),
    Color::Blue(0, 0, 1, 1), Color::Yellow(1, 1, 0, 1), Color::Purple(1, 0, 1, 1);

PID::PID(double p, double i, double d, double i_max, double i_min, double cmd_max, double cmd_min) {
  Init(p, i, d, i_max, i_min, cmd_max, cmd_min);
}

void PID::Init(double p, double i, double d, double i_max, double i_min, double cmd_max, double cmd_min) {
  p_ = p;
  i_ = i;
  d_ = d;
  i_max_ = i_max;
  i_min_ = i_min;
  cmd_max_ = cmd_max;
  cmd_min_ = cmd_min;
  Reset();
}

void PID::Reset() { p_last_ = p_error_ = i_error_ = d_error_ = command_ = 0.0; }

double PID::Update(double error, Time dt) {
  const double step = dt.Double();
  if (step == 0.0 || !std::isfinite(error)) return 0.0;
  p_error_ = error;
  i_error_ += step * error;
  double integral = i_ * i_error_;
  const double clamped = i_max_ >= i_min_ ? std::min(std::max(integral, i_min_), i_max_) : integral;
  if (clamped != integral && i_ != 0.0) i_error_ = clamped / i_;
  d_error_ = (p_error_ - p_last_) / step;
  p_last_ = p_error_;
  command_ = -p_ * p_error_ - clamped - d_ * d_error_;
  if (cmd_max_ >= cmd_min_) command_ = std::min(std::max(command_, cmd_min_), cmd_max_);
  return command_;
}

}  // namespace common
}  // namespace gazebo
