#pragma once

#include <cstdarg>
#include <cstddef>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "ros/platform.h"

#if defined(__GNUC__)
#define ROSCONSOLE_PRINTF_ATTRIBUTE(a, b) __attribute__((__format__(__printf__, a, b)))
#else
#define ROSCONSOLE_PRINTF_ATTRIBUTE(a, b)
#endif

namespace boost {
template <typename T>
class shared_array;
}

namespace ros {
/** Log messages: to the terminal, to /rosout, by the levels of loggers. */
namespace console {

namespace levels {
enum Level { Debug, Info, Warn, Error, Fatal, Count };
}
typedef levels::Level Level;

/** Receives every message that is enabled. */
class LogAppender {
 public:
  virtual ~LogAppender() {}
  virtual void log(Level level, const char* text, const char* file, const char* function, int line) = 0;
};

struct FilterParams {
  const char* file;
  int line;
  const char* function;
  const char* message;
  void* logger;
  levels::Level level;
  std::string out_message;
};

/** Filter that decides which messages of the macros with _FILTER are logged. */
class FilterBase {
 public:
  virtual ~FilterBase() {}
  virtual bool isEnabled() { return true; }
  virtual bool isEnabled(FilterParams&) { return true; }
};

/** State of one call of a macro. */
struct LogLocation {
  bool initialized_;
  bool logger_enabled_;
  levels::Level level_;
  void* logger_;
};

void initialize();
void shutdown();
void register_appender(LogAppender* appender);
void deregister_appender(LogAppender* appender);
bool get_loggers(std::map<std::string, levels::Level>& loggers);
/** Set the level of a logger, such as "ros.my_package"; false if the level is invalid. Call notifyLoggerLevelsChanged()
 * afterwards.
 */
bool set_logger_level(const std::string& name, levels::Level level);
void notifyLoggerLevelsChanged();
void initializeLogLocation(LogLocation* location, const std::string& name, levels::Level level);
void setLogLocationLevel(LogLocation* location, levels::Level level);
void checkLogLocationEnabled(LogLocation* location);
std::string formatToString(const char* format, ...) ROSCONSOLE_PRINTF_ATTRIBUTE(1, 2);
void print(FilterBase* filter, void* logger, Level level, const char* file, int line, const char* function,
           const char* format, ...) ROSCONSOLE_PRINTF_ATTRIBUTE(7, 8);
void print(FilterBase* filter, void* logger, Level level, const std::stringstream& text, const char* file, int line,
           const char* function);
/** Set a fixed token of the format, such as the node's name. */
void setFixedFilterToken(const std::string& key, const std::string& value);
/** True at most once in a period [s] of ROS time; with `delayed`, not at the first call. */
bool isDue(double& last, double period, bool delayed);

extern bool g_initialized;

}  // namespace console
}  // namespace ros

#define ROSCONSOLE_AUTOINIT                                           \
  do {                                                                \
    if (!::ros::console::g_initialized) ::ros::console::initialize(); \
  } while (false)

#define ROSCONSOLE_ROOT_LOGGER_NAME "ros"
#ifdef ROS_PACKAGE_NAME  // catkin's CMake defines it, with quotes
#define ROSCONSOLE_NAME_PREFIX ROSCONSOLE_ROOT_LOGGER_NAME "." ROS_PACKAGE_NAME
#else
#define ROSCONSOLE_NAME_PREFIX ROSCONSOLE_ROOT_LOGGER_NAME ".unknown_package"
#endif
#define ROSCONSOLE_DEFAULT_NAME ROSCONSOLE_NAME_PREFIX

#define ROSCONSOLE_SEVERITY_DEBUG 0
#define ROSCONSOLE_SEVERITY_INFO 1
#define ROSCONSOLE_SEVERITY_WARN 2
#define ROSCONSOLE_SEVERITY_ERROR 3
#define ROSCONSOLE_SEVERITY_FATAL 4
#define ROSCONSOLE_SEVERITY_NONE 5
#ifndef ROSCONSOLE_MIN_SEVERITY
#define ROSCONSOLE_MIN_SEVERITY ROSCONSOLE_SEVERITY_DEBUG
#endif

#define ROSCONSOLE_DEFINE_LOCATION(cond, level, name)                                                              \
  ROSCONSOLE_AUTOINIT;                                                                                             \
  static ::ros::console::LogLocation rosconsole_location = {false, false, ::ros::console::levels::Count, nullptr}; \
  if (!rosconsole_location.initialized_) ::ros::console::initializeLogLocation(&rosconsole_location, name, level); \
  if (rosconsole_location.level_ != (level)) ::ros::console::setLogLocationLevel(&rosconsole_location, level);     \
  const bool rosconsole_enabled = rosconsole_location.logger_enabled_ && (cond)

#define ROSCONSOLE_PRINT(filter, level, ...) \
  ::ros::console::print(filter, rosconsole_location.logger_, level, __FILE__, __LINE__, __func__, __VA_ARGS__)
#define ROSCONSOLE_PRINT_STREAM(filter, level, args)                                                                  \
  do {                                                                                                                \
    std::stringstream rosconsole_text;                                                                                \
    rosconsole_text << args;                                                                                          \
    ::ros::console::print(filter, rosconsole_location.logger_, level, rosconsole_text, __FILE__, __LINE__, __func__); \
  } while (false)

#define ROS_LOG_COND(cond, level, name, ...)                               \
  do {                                                                     \
    ROSCONSOLE_DEFINE_LOCATION(cond, level, name);                         \
    if (rosconsole_enabled) ROSCONSOLE_PRINT(nullptr, level, __VA_ARGS__); \
  } while (false)
#define ROS_LOG_STREAM_COND(cond, level, name, args)                       \
  do {                                                                     \
    ROSCONSOLE_DEFINE_LOCATION(cond, level, name);                         \
    if (rosconsole_enabled) ROSCONSOLE_PRINT_STREAM(nullptr, level, args); \
  } while (false)
#define ROS_LOG(level, name, ...) ROS_LOG_COND(true, level, name, __VA_ARGS__)
#define ROS_LOG_STREAM(level, name, args) ROS_LOG_STREAM_COND(true, level, name, args)
#define ROS_LOG_ONCE(level, name, ...)               \
  do {                                               \
    ROSCONSOLE_DEFINE_LOCATION(true, level, name);   \
    static bool rosconsole_hit = false;              \
    if (rosconsole_enabled && !rosconsole_hit) {     \
      rosconsole_hit = true;                         \
      ROSCONSOLE_PRINT(nullptr, level, __VA_ARGS__); \
    }                                                \
  } while (false)
#define ROS_LOG_STREAM_ONCE(level, name, args)       \
  do {                                               \
    ROSCONSOLE_DEFINE_LOCATION(true, level, name);   \
    static bool rosconsole_hit = false;              \
    if (rosconsole_enabled && !rosconsole_hit) {     \
      rosconsole_hit = true;                         \
      ROSCONSOLE_PRINT_STREAM(nullptr, level, args); \
    }                                                \
  } while (false)
#define ROSCONSOLE_THROTTLED(delayed, period, level, name, print)                             \
  do {                                                                                        \
    ROSCONSOLE_DEFINE_LOCATION(true, level, name);                                            \
    static double rosconsole_last = -1.0;                                                     \
    if (rosconsole_enabled && ::ros::console::isDue(rosconsole_last, period, delayed)) print; \
  } while (false)
#define ROS_LOG_THROTTLE(period, level, name, ...) \
  ROSCONSOLE_THROTTLED(false, period, level, name, ROSCONSOLE_PRINT(nullptr, level, __VA_ARGS__))
#define ROS_LOG_STREAM_THROTTLE(period, level, name, args) \
  ROSCONSOLE_THROTTLED(false, period, level, name, ROSCONSOLE_PRINT_STREAM(nullptr, level, args))
#define ROS_LOG_DELAYED_THROTTLE(period, level, name, ...) \
  ROSCONSOLE_THROTTLED(true, period, level, name, ROSCONSOLE_PRINT(nullptr, level, __VA_ARGS__))
#define ROS_LOG_STREAM_DELAYED_THROTTLE(period, level, name, args) \
  ROSCONSOLE_THROTTLED(true, period, level, name, ROSCONSOLE_PRINT_STREAM(nullptr, level, args))
#define ROS_LOG_FILTER(filter, level, name, ...)                                                   \
  do {                                                                                             \
    ROSCONSOLE_DEFINE_LOCATION(true, level, name);                                                 \
    if (rosconsole_enabled && (filter)->isEnabled()) ROSCONSOLE_PRINT(filter, level, __VA_ARGS__); \
  } while (false)
#define ROS_LOG_STREAM_FILTER(filter, level, name, args)                                           \
  do {                                                                                             \
    ROSCONSOLE_DEFINE_LOCATION(true, level, name);                                                 \
    if (rosconsole_enabled && (filter)->isEnabled()) ROSCONSOLE_PRINT_STREAM(filter, level, args); \
  } while (false)

// Macros of each level; those below ROSCONSOLE_MIN_SEVERITY compile to nothing.

#if ROSCONSOLE_MIN_SEVERITY > ROSCONSOLE_SEVERITY_DEBUG
#define ROS_DEBUG(...) static_cast<void>(0)
#define ROS_DEBUG_NAMED(name, ...) static_cast<void>(0)
#define ROS_DEBUG_STREAM(args) static_cast<void>(0)
#define ROS_DEBUG_STREAM_NAMED(name, args) static_cast<void>(0)
#define ROS_DEBUG_COND(cond, ...) static_cast<void>(0)
#define ROS_DEBUG_COND_NAMED(cond, name, ...) static_cast<void>(0)
#define ROS_DEBUG_STREAM_COND(cond, args) static_cast<void>(0)
#define ROS_DEBUG_STREAM_COND_NAMED(cond, name, args) static_cast<void>(0)
#define ROS_DEBUG_ONCE(...) static_cast<void>(0)
#define ROS_DEBUG_ONCE_NAMED(name, ...) static_cast<void>(0)
#define ROS_DEBUG_STREAM_ONCE(args) static_cast<void>(0)
#define ROS_DEBUG_STREAM_ONCE_NAMED(name, args) static_cast<void>(0)
#define ROS_DEBUG_THROTTLE(period, ...) static_cast<void>(0)
#define ROS_DEBUG_THROTTLE_NAMED(period, name, ...) static_cast<void>(0)
#define ROS_DEBUG_STREAM_THROTTLE(period, args) static_cast<void>(0)
#define ROS_DEBUG_STREAM_THROTTLE_NAMED(period, name, args) static_cast<void>(0)
#define ROS_DEBUG_DELAYED_THROTTLE(period, ...) static_cast<void>(0)
#define ROS_DEBUG_DELAYED_THROTTLE_NAMED(period, name, ...) static_cast<void>(0)
#define ROS_DEBUG_STREAM_DELAYED_THROTTLE(period, args) static_cast<void>(0)
#define ROS_DEBUG_STREAM_DELAYED_THROTTLE_NAMED(period, name, args) static_cast<void>(0)
#define ROS_DEBUG_FILTER(filter, ...) static_cast<void>(0)
#define ROS_DEBUG_FILTER_NAMED(filter, name, ...) static_cast<void>(0)
#define ROS_DEBUG_STREAM_FILTER(filter, args) static_cast<void>(0)
#define ROS_DEBUG_STREAM_FILTER_NAMED(filter, name, args) static_cast<void>(0)
#else
#define ROS_DEBUG(...) ROS_LOG(::ros::console::levels::Debug, ROSCONSOLE_DEFAULT_NAME, __VA_ARGS__)
#define ROS_DEBUG_NAMED(name, ...) \
  ROS_LOG(::ros::console::levels::Debug, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, __VA_ARGS__)
#define ROS_DEBUG_STREAM(args) ROS_LOG_STREAM(::ros::console::levels::Debug, ROSCONSOLE_DEFAULT_NAME, args)
#define ROS_DEBUG_STREAM_NAMED(name, args) \
  ROS_LOG_STREAM(::ros::console::levels::Debug, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, args)
#define ROS_DEBUG_COND(cond, ...) \
  ROS_LOG_COND(cond, ::ros::console::levels::Debug, ROSCONSOLE_DEFAULT_NAME, __VA_ARGS__)
#define ROS_DEBUG_COND_NAMED(cond, name, ...) \
  ROS_LOG_COND(cond, ::ros::console::levels::Debug, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, __VA_ARGS__)
#define ROS_DEBUG_STREAM_COND(cond, args) \
  ROS_LOG_STREAM_COND(cond, ::ros::console::levels::Debug, ROSCONSOLE_DEFAULT_NAME, args)
#define ROS_DEBUG_STREAM_COND_NAMED(cond, name, args) \
  ROS_LOG_STREAM_COND(cond, ::ros::console::levels::Debug, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, args)
#define ROS_DEBUG_ONCE(...) ROS_LOG_ONCE(::ros::console::levels::Debug, ROSCONSOLE_DEFAULT_NAME, __VA_ARGS__)
#define ROS_DEBUG_ONCE_NAMED(name, ...) \
  ROS_LOG_ONCE(::ros::console::levels::Debug, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, __VA_ARGS__)
#define ROS_DEBUG_STREAM_ONCE(args) ROS_LOG_STREAM_ONCE(::ros::console::levels::Debug, ROSCONSOLE_DEFAULT_NAME, args)
#define ROS_DEBUG_STREAM_ONCE_NAMED(name, args) \
  ROS_LOG_STREAM_ONCE(::ros::console::levels::Debug, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, args)
#define ROS_DEBUG_THROTTLE(period, ...) \
  ROS_LOG_THROTTLE(period, ::ros::console::levels::Debug, ROSCONSOLE_DEFAULT_NAME, __VA_ARGS__)
#define ROS_DEBUG_THROTTLE_NAMED(period, name, ...) \
  ROS_LOG_THROTTLE(period, ::ros::console::levels::Debug, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, __VA_ARGS__)
#define ROS_DEBUG_STREAM_THROTTLE(period, args) \
  ROS_LOG_STREAM_THROTTLE(period, ::ros::console::levels::Debug, ROSCONSOLE_DEFAULT_NAME, args)
#define ROS_DEBUG_STREAM_THROTTLE_NAMED(period, name, args) \
  ROS_LOG_STREAM_THROTTLE(period, ::ros::console::levels::Debug, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, args)
#define ROS_DEBUG_DELAYED_THROTTLE(period, ...) \
  ROS_LOG_DELAYED_THROTTLE(period, ::ros::console::levels::Debug, ROSCONSOLE_DEFAULT_NAME, __VA_ARGS__)
#define ROS_DEBUG_DELAYED_THROTTLE_NAMED(period, name, ...)                                                         \
  ROS_LOG_DELAYED_THROTTLE(period, ::ros::console::levels::Debug, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, \
                           __VA_ARGS__)
#define ROS_DEBUG_STREAM_DELAYED_THROTTLE(period, args) \
  ROS_LOG_STREAM_DELAYED_THROTTLE(period, ::ros::console::levels::Debug, ROSCONSOLE_DEFAULT_NAME, args)
#define ROS_DEBUG_STREAM_DELAYED_THROTTLE_NAMED(period, name, args)      \
  ROS_LOG_STREAM_DELAYED_THROTTLE(period, ::ros::console::levels::Debug, \
                                  std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, args)
#define ROS_DEBUG_FILTER(filter, ...) \
  ROS_LOG_FILTER(filter, ::ros::console::levels::Debug, ROSCONSOLE_DEFAULT_NAME, __VA_ARGS__)
#define ROS_DEBUG_FILTER_NAMED(filter, name, ...) \
  ROS_LOG_FILTER(filter, ::ros::console::levels::Debug, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, __VA_ARGS__)
#define ROS_DEBUG_STREAM_FILTER(filter, args) \
  ROS_LOG_STREAM_FILTER(filter, ::ros::console::levels::Debug, ROSCONSOLE_DEFAULT_NAME, args)
#define ROS_DEBUG_STREAM_FILTER_NAMED(filter, name, args) \
  ROS_LOG_STREAM_FILTER(filter, ::ros::console::levels::Debug, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, args)
#endif

#if ROSCONSOLE_MIN_SEVERITY > ROSCONSOLE_SEVERITY_INFO
#define ROS_INFO(...) static_cast<void>(0)
#define ROS_INFO_NAMED(name, ...) static_cast<void>(0)
#define ROS_INFO_STREAM(args) static_cast<void>(0)
#define ROS_INFO_STREAM_NAMED(name, args) static_cast<void>(0)
#define ROS_INFO_COND(cond, ...) static_cast<void>(0)
#define ROS_INFO_COND_NAMED(cond, name, ...) static_cast<void>(0)
#define ROS_INFO_STREAM_COND(cond, args) static_cast<void>(0)
#define ROS_INFO_STREAM_COND_NAMED(cond, name, args) static_cast<void>(0)
#define ROS_INFO_ONCE(...) static_cast<void>(0)
#define ROS_INFO_ONCE_NAMED(name, ...) static_cast<void>(0)
#define ROS_INFO_STREAM_ONCE(args) static_cast<void>(0)
#define ROS_INFO_STREAM_ONCE_NAMED(name, args) static_cast<void>(0)
#define ROS_INFO_THROTTLE(period, ...) static_cast<void>(0)
#define ROS_INFO_THROTTLE_NAMED(period, name, ...) static_cast<void>(0)
#define ROS_INFO_STREAM_THROTTLE(period, args) static_cast<void>(0)
#define ROS_INFO_STREAM_THROTTLE_NAMED(period, name, args) static_cast<void>(0)
#define ROS_INFO_DELAYED_THROTTLE(period, ...) static_cast<void>(0)
#define ROS_INFO_DELAYED_THROTTLE_NAMED(period, name, ...) static_cast<void>(0)
#define ROS_INFO_STREAM_DELAYED_THROTTLE(period, args) static_cast<void>(0)
#define ROS_INFO_STREAM_DELAYED_THROTTLE_NAMED(period, name, args) static_cast<void>(0)
#define ROS_INFO_FILTER(filter, ...) static_cast<void>(0)
#define ROS_INFO_FILTER_NAMED(filter, name, ...) static_cast<void>(0)
#define ROS_INFO_STREAM_FILTER(filter, args) static_cast<void>(0)
#define ROS_INFO_STREAM_FILTER_NAMED(filter, name, args) static_cast<void>(0)
#else
#define ROS_INFO(...) ROS_LOG(::ros::console::levels::Info, ROSCONSOLE_DEFAULT_NAME, __VA_ARGS__)
#define ROS_INFO_NAMED(name, ...) \
  ROS_LOG(::ros::console::levels::Info, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, __VA_ARGS__)
#define ROS_INFO_STREAM(args) ROS_LOG_STREAM(::ros::console::levels::Info, ROSCONSOLE_DEFAULT_NAME, args)
#define ROS_INFO_STREAM_NAMED(name, args) \
  ROS_LOG_STREAM(::ros::console::levels::Info, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, args)
#define ROS_INFO_COND(cond, ...) ROS_LOG_COND(cond, ::ros::console::levels::Info, ROSCONSOLE_DEFAULT_NAME, __VA_ARGS__)
#define ROS_INFO_COND_NAMED(cond, name, ...) \
  ROS_LOG_COND(cond, ::ros::console::levels::Info, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, __VA_ARGS__)
#define ROS_INFO_STREAM_COND(cond, args) \
  ROS_LOG_STREAM_COND(cond, ::ros::console::levels::Info, ROSCONSOLE_DEFAULT_NAME, args)
#define ROS_INFO_STREAM_COND_NAMED(cond, name, args) \
  ROS_LOG_STREAM_COND(cond, ::ros::console::levels::Info, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, args)
#define ROS_INFO_ONCE(...) ROS_LOG_ONCE(::ros::console::levels::Info, ROSCONSOLE_DEFAULT_NAME, __VA_ARGS__)
#define ROS_INFO_ONCE_NAMED(name, ...) \
  ROS_LOG_ONCE(::ros::console::levels::Info, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, __VA_ARGS__)
#define ROS_INFO_STREAM_ONCE(args) ROS_LOG_STREAM_ONCE(::ros::console::levels::Info, ROSCONSOLE_DEFAULT_NAME, args)
#define ROS_INFO_STREAM_ONCE_NAMED(name, args) \
  ROS_LOG_STREAM_ONCE(::ros::console::levels::Info, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, args)
#define ROS_INFO_THROTTLE(period, ...) \
  ROS_LOG_THROTTLE(period, ::ros::console::levels::Info, ROSCONSOLE_DEFAULT_NAME, __VA_ARGS__)
#define ROS_INFO_THROTTLE_NAMED(period, name, ...) \
  ROS_LOG_THROTTLE(period, ::ros::console::levels::Info, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, __VA_ARGS__)
#define ROS_INFO_STREAM_THROTTLE(period, args) \
  ROS_LOG_STREAM_THROTTLE(period, ::ros::console::levels::Info, ROSCONSOLE_DEFAULT_NAME, args)
#define ROS_INFO_STREAM_THROTTLE_NAMED(period, name, args) \
  ROS_LOG_STREAM_THROTTLE(period, ::ros::console::levels::Info, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, args)
#define ROS_INFO_DELAYED_THROTTLE(period, ...) \
  ROS_LOG_DELAYED_THROTTLE(period, ::ros::console::levels::Info, ROSCONSOLE_DEFAULT_NAME, __VA_ARGS__)
#define ROS_INFO_DELAYED_THROTTLE_NAMED(period, name, ...)                                                         \
  ROS_LOG_DELAYED_THROTTLE(period, ::ros::console::levels::Info, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, \
                           __VA_ARGS__)
#define ROS_INFO_STREAM_DELAYED_THROTTLE(period, args) \
  ROS_LOG_STREAM_DELAYED_THROTTLE(period, ::ros::console::levels::Info, ROSCONSOLE_DEFAULT_NAME, args)
#define ROS_INFO_STREAM_DELAYED_THROTTLE_NAMED(period, name, args)      \
  ROS_LOG_STREAM_DELAYED_THROTTLE(period, ::ros::console::levels::Info, \
                                  std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, args)
#define ROS_INFO_FILTER(filter, ...) \
  ROS_LOG_FILTER(filter, ::ros::console::levels::Info, ROSCONSOLE_DEFAULT_NAME, __VA_ARGS__)
#define ROS_INFO_FILTER_NAMED(filter, name, ...) \
  ROS_LOG_FILTER(filter, ::ros::console::levels::Info, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, __VA_ARGS__)
#define ROS_INFO_STREAM_FILTER(filter, args) \
  ROS_LOG_STREAM_FILTER(filter, ::ros::console::levels::Info, ROSCONSOLE_DEFAULT_NAME, args)
#define ROS_INFO_STREAM_FILTER_NAMED(filter, name, args) \
  ROS_LOG_STREAM_FILTER(filter, ::ros::console::levels::Info, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, args)
#endif

#if ROSCONSOLE_MIN_SEVERITY > ROSCONSOLE_SEVERITY_WARN
#define ROS_WARN(...) static_cast<void>(0)
#define ROS_WARN_NAMED(name, ...) static_cast<void>(0)
#define ROS_WARN_STREAM(args) static_cast<void>(0)
#define ROS_WARN_STREAM_NAMED(name, args) static_cast<void>(0)
#define ROS_WARN_COND(cond, ...) static_cast<void>(0)
#define ROS_WARN_COND_NAMED(cond, name, ...) static_cast<void>(0)
#define ROS_WARN_STREAM_COND(cond, args) static_cast<void>(0)
#define ROS_WARN_STREAM_COND_NAMED(cond, name, args) static_cast<void>(0)
#define ROS_WARN_ONCE(...) static_cast<void>(0)
#define ROS_WARN_ONCE_NAMED(name, ...) static_cast<void>(0)
#define ROS_WARN_STREAM_ONCE(args) static_cast<void>(0)
#define ROS_WARN_STREAM_ONCE_NAMED(name, args) static_cast<void>(0)
#define ROS_WARN_THROTTLE(period, ...) static_cast<void>(0)
#define ROS_WARN_THROTTLE_NAMED(period, name, ...) static_cast<void>(0)
#define ROS_WARN_STREAM_THROTTLE(period, args) static_cast<void>(0)
#define ROS_WARN_STREAM_THROTTLE_NAMED(period, name, args) static_cast<void>(0)
#define ROS_WARN_DELAYED_THROTTLE(period, ...) static_cast<void>(0)
#define ROS_WARN_DELAYED_THROTTLE_NAMED(period, name, ...) static_cast<void>(0)
#define ROS_WARN_STREAM_DELAYED_THROTTLE(period, args) static_cast<void>(0)
#define ROS_WARN_STREAM_DELAYED_THROTTLE_NAMED(period, name, args) static_cast<void>(0)
#define ROS_WARN_FILTER(filter, ...) static_cast<void>(0)
#define ROS_WARN_FILTER_NAMED(filter, name, ...) static_cast<void>(0)
#define ROS_WARN_STREAM_FILTER(filter, args) static_cast<void>(0)
#define ROS_WARN_STREAM_FILTER_NAMED(filter, name, args) static_cast<void>(0)
#else
#define ROS_WARN(...) ROS_LOG(::ros::console::levels::Warn, ROSCONSOLE_DEFAULT_NAME, __VA_ARGS__)
#define ROS_WARN_NAMED(name, ...) \
  ROS_LOG(::ros::console::levels::Warn, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, __VA_ARGS__)
#define ROS_WARN_STREAM(args) ROS_LOG_STREAM(::ros::console::levels::Warn, ROSCONSOLE_DEFAULT_NAME, args)
#define ROS_WARN_STREAM_NAMED(name, args) \
  ROS_LOG_STREAM(::ros::console::levels::Warn, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, args)
#define ROS_WARN_COND(cond, ...) ROS_LOG_COND(cond, ::ros::console::levels::Warn, ROSCONSOLE_DEFAULT_NAME, __VA_ARGS__)
#define ROS_WARN_COND_NAMED(cond, name, ...) \
  ROS_LOG_COND(cond, ::ros::console::levels::Warn, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, __VA_ARGS__)
#define ROS_WARN_STREAM_COND(cond, args) \
  ROS_LOG_STREAM_COND(cond, ::ros::console::levels::Warn, ROSCONSOLE_DEFAULT_NAME, args)
#define ROS_WARN_STREAM_COND_NAMED(cond, name, args) \
  ROS_LOG_STREAM_COND(cond, ::ros::console::levels::Warn, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, args)
#define ROS_WARN_ONCE(...) ROS_LOG_ONCE(::ros::console::levels::Warn, ROSCONSOLE_DEFAULT_NAME, __VA_ARGS__)
#define ROS_WARN_ONCE_NAMED(name, ...) \
  ROS_LOG_ONCE(::ros::console::levels::Warn, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, __VA_ARGS__)
#define ROS_WARN_STREAM_ONCE(args) ROS_LOG_STREAM_ONCE(::ros::console::levels::Warn, ROSCONSOLE_DEFAULT_NAME, args)
#define ROS_WARN_STREAM_ONCE_NAMED(name, args) \
  ROS_LOG_STREAM_ONCE(::ros::console::levels::Warn, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, args)
#define ROS_WARN_THROTTLE(period, ...) \
  ROS_LOG_THROTTLE(period, ::ros::console::levels::Warn, ROSCONSOLE_DEFAULT_NAME, __VA_ARGS__)
#define ROS_WARN_THROTTLE_NAMED(period, name, ...) \
  ROS_LOG_THROTTLE(period, ::ros::console::levels::Warn, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, __VA_ARGS__)
#define ROS_WARN_STREAM_THROTTLE(period, args) \
  ROS_LOG_STREAM_THROTTLE(period, ::ros::console::levels::Warn, ROSCONSOLE_DEFAULT_NAME, args)
#define ROS_WARN_STREAM_THROTTLE_NAMED(period, name, args) \
  ROS_LOG_STREAM_THROTTLE(period, ::ros::console::levels::Warn, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, args)
#define ROS_WARN_DELAYED_THROTTLE(period, ...) \
  ROS_LOG_DELAYED_THROTTLE(period, ::ros::console::levels::Warn, ROSCONSOLE_DEFAULT_NAME, __VA_ARGS__)
#define ROS_WARN_DELAYED_THROTTLE_NAMED(period, name, ...)                                                         \
  ROS_LOG_DELAYED_THROTTLE(period, ::ros::console::levels::Warn, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, \
                           __VA_ARGS__)
#define ROS_WARN_STREAM_DELAYED_THROTTLE(period, args) \
  ROS_LOG_STREAM_DELAYED_THROTTLE(period, ::ros::console::levels::Warn, ROSCONSOLE_DEFAULT_NAME, args)
#define ROS_WARN_STREAM_DELAYED_THROTTLE_NAMED(period, name, args)      \
  ROS_LOG_STREAM_DELAYED_THROTTLE(period, ::ros::console::levels::Warn, \
                                  std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, args)
#define ROS_WARN_FILTER(filter, ...) \
  ROS_LOG_FILTER(filter, ::ros::console::levels::Warn, ROSCONSOLE_DEFAULT_NAME, __VA_ARGS__)
#define ROS_WARN_FILTER_NAMED(filter, name, ...) \
  ROS_LOG_FILTER(filter, ::ros::console::levels::Warn, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, __VA_ARGS__)
#define ROS_WARN_STREAM_FILTER(filter, args) \
  ROS_LOG_STREAM_FILTER(filter, ::ros::console::levels::Warn, ROSCONSOLE_DEFAULT_NAME, args)
#define ROS_WARN_STREAM_FILTER_NAMED(filter, name, args) \
  ROS_LOG_STREAM_FILTER(filter, ::ros::console::levels::Warn, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, args)
#endif

#if ROSCONSOLE_MIN_SEVERITY > ROSCONSOLE_SEVERITY_ERROR
#define ROS_ERROR(...) static_cast<void>(0)
#define ROS_ERROR_NAMED(name, ...) static_cast<void>(0)
#define ROS_ERROR_STREAM(args) static_cast<void>(0)
#define ROS_ERROR_STREAM_NAMED(name, args) static_cast<void>(0)
#define ROS_ERROR_COND(cond, ...) static_cast<void>(0)
#define ROS_ERROR_COND_NAMED(cond, name, ...) static_cast<void>(0)
#define ROS_ERROR_STREAM_COND(cond, args) static_cast<void>(0)
#define ROS_ERROR_STREAM_COND_NAMED(cond, name, args) static_cast<void>(0)
#define ROS_ERROR_ONCE(...) static_cast<void>(0)
#define ROS_ERROR_ONCE_NAMED(name, ...) static_cast<void>(0)
#define ROS_ERROR_STREAM_ONCE(args) static_cast<void>(0)
#define ROS_ERROR_STREAM_ONCE_NAMED(name, args) static_cast<void>(0)
#define ROS_ERROR_THROTTLE(period, ...) static_cast<void>(0)
#define ROS_ERROR_THROTTLE_NAMED(period, name, ...) static_cast<void>(0)
#define ROS_ERROR_STREAM_THROTTLE(period, args) static_cast<void>(0)
#define ROS_ERROR_STREAM_THROTTLE_NAMED(period, name, args) static_cast<void>(0)
#define ROS_ERROR_DELAYED_THROTTLE(period, ...) static_cast<void>(0)
#define ROS_ERROR_DELAYED_THROTTLE_NAMED(period, name, ...) static_cast<void>(0)
#define ROS_ERROR_STREAM_DELAYED_THROTTLE(period, args) static_cast<void>(0)
#define ROS_ERROR_STREAM_DELAYED_THROTTLE_NAMED(period, name, args) static_cast<void>(0)
#define ROS_ERROR_FILTER(filter, ...) static_cast<void>(0)
#define ROS_ERROR_FILTER_NAMED(filter, name, ...) static_cast<void>(0)
#define ROS_ERROR_STREAM_FILTER(filter, args) static_cast<void>(0)
#define ROS_ERROR_STREAM_FILTER_NAMED(filter, name, args) static_cast<void>(0)
#else
#define ROS_ERROR(...) ROS_LOG(::ros::console::levels::Error, ROSCONSOLE_DEFAULT_NAME, __VA_ARGS__)
#define ROS_ERROR_NAMED(name, ...) \
  ROS_LOG(::ros::console::levels::Error, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, __VA_ARGS__)
#define ROS_ERROR_STREAM(args) ROS_LOG_STREAM(::ros::console::levels::Error, ROSCONSOLE_DEFAULT_NAME, args)
#define ROS_ERROR_STREAM_NAMED(name, args) \
  ROS_LOG_STREAM(::ros::console::levels::Error, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, args)
#define ROS_ERROR_COND(cond, ...) \
  ROS_LOG_COND(cond, ::ros::console::levels::Error, ROSCONSOLE_DEFAULT_NAME, __VA_ARGS__)
#define ROS_ERROR_COND_NAMED(cond, name, ...) \
  ROS_LOG_COND(cond, ::ros::console::levels::Error, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, __VA_ARGS__)
#define ROS_ERROR_STREAM_COND(cond, args) \
  ROS_LOG_STREAM_COND(cond, ::ros::console::levels::Error, ROSCONSOLE_DEFAULT_NAME, args)
#define ROS_ERROR_STREAM_COND_NAMED(cond, name, args) \
  ROS_LOG_STREAM_COND(cond, ::ros::console::levels::Error, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, args)
#define ROS_ERROR_ONCE(...) ROS_LOG_ONCE(::ros::console::levels::Error, ROSCONSOLE_DEFAULT_NAME, __VA_ARGS__)
#define ROS_ERROR_ONCE_NAMED(name, ...) \
  ROS_LOG_ONCE(::ros::console::levels::Error, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, __VA_ARGS__)
#define ROS_ERROR_STREAM_ONCE(args) ROS_LOG_STREAM_ONCE(::ros::console::levels::Error, ROSCONSOLE_DEFAULT_NAME, args)
#define ROS_ERROR_STREAM_ONCE_NAMED(name, args) \
  ROS_LOG_STREAM_ONCE(::ros::console::levels::Error, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, args)
#define ROS_ERROR_THROTTLE(period, ...) \
  ROS_LOG_THROTTLE(period, ::ros::console::levels::Error, ROSCONSOLE_DEFAULT_NAME, __VA_ARGS__)
#define ROS_ERROR_THROTTLE_NAMED(period, name, ...) \
  ROS_LOG_THROTTLE(period, ::ros::console::levels::Error, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, __VA_ARGS__)
#define ROS_ERROR_STREAM_THROTTLE(period, args) \
  ROS_LOG_STREAM_THROTTLE(period, ::ros::console::levels::Error, ROSCONSOLE_DEFAULT_NAME, args)
#define ROS_ERROR_STREAM_THROTTLE_NAMED(period, name, args) \
  ROS_LOG_STREAM_THROTTLE(period, ::ros::console::levels::Error, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, args)
#define ROS_ERROR_DELAYED_THROTTLE(period, ...) \
  ROS_LOG_DELAYED_THROTTLE(period, ::ros::console::levels::Error, ROSCONSOLE_DEFAULT_NAME, __VA_ARGS__)
#define ROS_ERROR_DELAYED_THROTTLE_NAMED(period, name, ...)                                                         \
  ROS_LOG_DELAYED_THROTTLE(period, ::ros::console::levels::Error, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, \
                           __VA_ARGS__)
#define ROS_ERROR_STREAM_DELAYED_THROTTLE(period, args) \
  ROS_LOG_STREAM_DELAYED_THROTTLE(period, ::ros::console::levels::Error, ROSCONSOLE_DEFAULT_NAME, args)
#define ROS_ERROR_STREAM_DELAYED_THROTTLE_NAMED(period, name, args)      \
  ROS_LOG_STREAM_DELAYED_THROTTLE(period, ::ros::console::levels::Error, \
                                  std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, args)
#define ROS_ERROR_FILTER(filter, ...) \
  ROS_LOG_FILTER(filter, ::ros::console::levels::Error, ROSCONSOLE_DEFAULT_NAME, __VA_ARGS__)
#define ROS_ERROR_FILTER_NAMED(filter, name, ...) \
  ROS_LOG_FILTER(filter, ::ros::console::levels::Error, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, __VA_ARGS__)
#define ROS_ERROR_STREAM_FILTER(filter, args) \
  ROS_LOG_STREAM_FILTER(filter, ::ros::console::levels::Error, ROSCONSOLE_DEFAULT_NAME, args)
#define ROS_ERROR_STREAM_FILTER_NAMED(filter, name, args) \
  ROS_LOG_STREAM_FILTER(filter, ::ros::console::levels::Error, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, args)
#endif

#if ROSCONSOLE_MIN_SEVERITY > ROSCONSOLE_SEVERITY_FATAL
#define ROS_FATAL(...) static_cast<void>(0)
#define ROS_FATAL_NAMED(name, ...) static_cast<void>(0)
#define ROS_FATAL_STREAM(args) static_cast<void>(0)
#define ROS_FATAL_STREAM_NAMED(name, args) static_cast<void>(0)
#define ROS_FATAL_COND(cond, ...) static_cast<void>(0)
#define ROS_FATAL_COND_NAMED(cond, name, ...) static_cast<void>(0)
#define ROS_FATAL_STREAM_COND(cond, args) static_cast<void>(0)
#define ROS_FATAL_STREAM_COND_NAMED(cond, name, args) static_cast<void>(0)
#define ROS_FATAL_ONCE(...) static_cast<void>(0)
#define ROS_FATAL_ONCE_NAMED(name, ...) static_cast<void>(0)
#define ROS_FATAL_STREAM_ONCE(args) static_cast<void>(0)
#define ROS_FATAL_STREAM_ONCE_NAMED(name, args) static_cast<void>(0)
#define ROS_FATAL_THROTTLE(period, ...) static_cast<void>(0)
#define ROS_FATAL_THROTTLE_NAMED(period, name, ...) static_cast<void>(0)
#define ROS_FATAL_STREAM_THROTTLE(period, args) static_cast<void>(0)
#define ROS_FATAL_STREAM_THROTTLE_NAMED(period, name, args) static_cast<void>(0)
#define ROS_FATAL_DELAYED_THROTTLE(period, ...) static_cast<void>(0)
#define ROS_FATAL_DELAYED_THROTTLE_NAMED(period, name, ...) static_cast<void>(0)
#define ROS_FATAL_STREAM_DELAYED_THROTTLE(period, args) static_cast<void>(0)
#define ROS_FATAL_STREAM_DELAYED_THROTTLE_NAMED(period, name, args) static_cast<void>(0)
#define ROS_FATAL_FILTER(filter, ...) static_cast<void>(0)
#define ROS_FATAL_FILTER_NAMED(filter, name, ...) static_cast<void>(0)
#define ROS_FATAL_STREAM_FILTER(filter, args) static_cast<void>(0)
#define ROS_FATAL_STREAM_FILTER_NAMED(filter, name, args) static_cast<void>(0)
#else
#define ROS_FATAL(...) ROS_LOG(::ros::console::levels::Fatal, ROSCONSOLE_DEFAULT_NAME, __VA_ARGS__)
#define ROS_FATAL_NAMED(name, ...) \
  ROS_LOG(::ros::console::levels::Fatal, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, __VA_ARGS__)
#define ROS_FATAL_STREAM(args) ROS_LOG_STREAM(::ros::console::levels::Fatal, ROSCONSOLE_DEFAULT_NAME, args)
#define ROS_FATAL_STREAM_NAMED(name, args) \
  ROS_LOG_STREAM(::ros::console::levels::Fatal, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, args)
#define ROS_FATAL_COND(cond, ...) \
  ROS_LOG_COND(cond, ::ros::console::levels::Fatal, ROSCONSOLE_DEFAULT_NAME, __VA_ARGS__)
#define ROS_FATAL_COND_NAMED(cond, name, ...) \
  ROS_LOG_COND(cond, ::ros::console::levels::Fatal, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, __VA_ARGS__)
#define ROS_FATAL_STREAM_COND(cond, args) \
  ROS_LOG_STREAM_COND(cond, ::ros::console::levels::Fatal, ROSCONSOLE_DEFAULT_NAME, args)
#define ROS_FATAL_STREAM_COND_NAMED(cond, name, args) \
  ROS_LOG_STREAM_COND(cond, ::ros::console::levels::Fatal, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, args)
#define ROS_FATAL_ONCE(...) ROS_LOG_ONCE(::ros::console::levels::Fatal, ROSCONSOLE_DEFAULT_NAME, __VA_ARGS__)
#define ROS_FATAL_ONCE_NAMED(name, ...) \
  ROS_LOG_ONCE(::ros::console::levels::Fatal, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, __VA_ARGS__)
#define ROS_FATAL_STREAM_ONCE(args) ROS_LOG_STREAM_ONCE(::ros::console::levels::Fatal, ROSCONSOLE_DEFAULT_NAME, args)
#define ROS_FATAL_STREAM_ONCE_NAMED(name, args) \
  ROS_LOG_STREAM_ONCE(::ros::console::levels::Fatal, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, args)
#define ROS_FATAL_THROTTLE(period, ...) \
  ROS_LOG_THROTTLE(period, ::ros::console::levels::Fatal, ROSCONSOLE_DEFAULT_NAME, __VA_ARGS__)
#define ROS_FATAL_THROTTLE_NAMED(period, name, ...) \
  ROS_LOG_THROTTLE(period, ::ros::console::levels::Fatal, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, __VA_ARGS__)
#define ROS_FATAL_STREAM_THROTTLE(period, args) \
  ROS_LOG_STREAM_THROTTLE(period, ::ros::console::levels::Fatal, ROSCONSOLE_DEFAULT_NAME, args)
#define ROS_FATAL_STREAM_THROTTLE_NAMED(period, name, args) \
  ROS_LOG_STREAM_THROTTLE(period, ::ros::console::levels::Fatal, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, args)
#define ROS_FATAL_DELAYED_THROTTLE(period, ...) \
  ROS_LOG_DELAYED_THROTTLE(period, ::ros::console::levels::Fatal, ROSCONSOLE_DEFAULT_NAME, __VA_ARGS__)
#define ROS_FATAL_DELAYED_THROTTLE_NAMED(period, name, ...)                                                         \
  ROS_LOG_DELAYED_THROTTLE(period, ::ros::console::levels::Fatal, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, \
                           __VA_ARGS__)
#define ROS_FATAL_STREAM_DELAYED_THROTTLE(period, args) \
  ROS_LOG_STREAM_DELAYED_THROTTLE(period, ::ros::console::levels::Fatal, ROSCONSOLE_DEFAULT_NAME, args)
#define ROS_FATAL_STREAM_DELAYED_THROTTLE_NAMED(period, name, args)      \
  ROS_LOG_STREAM_DELAYED_THROTTLE(period, ::ros::console::levels::Fatal, \
                                  std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, args)
#define ROS_FATAL_FILTER(filter, ...) \
  ROS_LOG_FILTER(filter, ::ros::console::levels::Fatal, ROSCONSOLE_DEFAULT_NAME, __VA_ARGS__)
#define ROS_FATAL_FILTER_NAMED(filter, name, ...) \
  ROS_LOG_FILTER(filter, ::ros::console::levels::Fatal, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, __VA_ARGS__)
#define ROS_FATAL_STREAM_FILTER(filter, args) \
  ROS_LOG_STREAM_FILTER(filter, ::ros::console::levels::Fatal, ROSCONSOLE_DEFAULT_NAME, args)
#define ROS_FATAL_STREAM_FILTER_NAMED(filter, name, args) \
  ROS_LOG_STREAM_FILTER(filter, ::ros::console::levels::Fatal, std::string(ROSCONSOLE_NAME_PREFIX) + "." + name, args)
#endif
