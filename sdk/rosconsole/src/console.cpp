#include "ros/console.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <mutex>

#include "ros/time.h"

namespace ros {
namespace console {
namespace {

/** Logger by its dotted name; a logger without a level has that of its nearest ancestor. */
struct Logger {
  std::string name;
  Level level = levels::Count;
};

struct State {
  std::recursive_mutex mutex;
  std::map<std::string, std::unique_ptr<Logger>> loggers;
  std::vector<LogLocation*> locations;
  std::vector<LogAppender*> appenders;
  std::map<std::string, std::string> tokens;
  std::string format = "[${severity}] [${time}]: ${message}";
  std::mutex output;
};

State& state() {
  static State* const instance = new State;  // never destroyed, as threads may log while the process exits
  return *instance;
}

constexpr std::array<const char*, levels::Count> kNames = {"DEBUG", " INFO", " WARN", "ERROR", "FATAL"};
constexpr std::array<const char*, levels::Count> kColors = {"\033[32m", "\033[0m", "\033[33m", "\033[31m", "\033[31m"};

Logger* find(const std::string& name) {
  std::unique_ptr<Logger>& logger = state().loggers[name];
  if (!logger) {
    logger = std::make_unique<Logger>();
    logger->name = name;
  }
  return logger.get();
}

Level effectiveLevel(std::string name) {
  while (true) {
    const auto found = state().loggers.find(name);
    if (found != state().loggers.end() && found->second->level != levels::Count) return found->second->level;
    const size_t dot = name.rfind('.');
    if (dot == std::string::npos) return levels::Info;
    name.resize(dot);
  }
}

bool parseLevel(std::string word, Level& level) {
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::toupper(c); });
  for (int i = 0; i < levels::Count; ++i)
    if (std::string(kNames[i]).find(word) != std::string::npos && word.size() >= 4) {
      level = static_cast<Level>(i);
      return true;
    }
  return false;
}

/** Read `log4j.logger.ros.NAME=LEVEL` lines of a ROSCONSOLE_CONFIG_FILE. */
void readConfiguration(const char* path) {
  std::ifstream file(path);
  std::string line;
  while (std::getline(file, line)) {
    line.erase(std::remove_if(line.begin(), line.end(), [](unsigned char c) { return std::isspace(c); }), line.end());
    const std::string prefix = "log4j.logger.";
    const size_t equals = line.find('=');
    Level level;
    if (line.compare(0, prefix.size(), prefix) != 0 || equals == std::string::npos) continue;
    const std::string value = line.substr(equals + 1, line.find(',', equals) - equals - 1);
    if (parseLevel(value, level)) find(line.substr(prefix.size(), equals - prefix.size()))->level = level;
  }
}

std::string timeText() {
  std::stringstream text;
  text << WallTime::now();
  if (Time::isSimTime()) text << ", " << Time::now();
  return text.str();
}

std::string word(const std::string& key, const FilterParams& p) {
  if (key == "severity") return kNames[p.level];
  if (key == "message") return p.message;
  if (key == "time") return timeText();
  if (key == "walltime") return (std::stringstream() << WallTime::now()).str();
  if (key == "thread") return (std::stringstream() << std::hex << reinterpret_cast<uintptr_t>(&errno)).str();
  if (key == "logger") return p.logger ? static_cast<Logger*>(p.logger)->name : "";
  if (key == "file") return p.file;
  if (key == "line") return std::to_string(p.line);
  if (key == "function") return p.function;
  const auto token = state().tokens.find(key);
  return token == state().tokens.end() ? "${" + key + "}" : token->second;
}

std::string formatted(const FilterParams& p) {
  std::string text;
  const std::string& format = state().format;
  for (size_t i = 0; i < format.size();) {
    const size_t end = format.compare(i, 2, "${") == 0 ? format.find('}', i) : std::string::npos;
    if (end == std::string::npos) {
      text += format[i++];
      continue;
    }
    text += word(format.substr(i + 2, end - i - 2), p);
    i = end + 1;
  }
  return text;
}

void emit(FilterBase* filter, void* logger, Level level, const char* text, const char* file, int line,
          const char* function) {
  FilterParams params = {file, line, function, text, logger, level, ""};
  if (filter) {
    if (!filter->isEnabled(params)) return;
    if (!params.out_message.empty()) params.message = params.out_message.c_str();
  }
  State& s = state();
  std::vector<LogAppender*> appenders;
  std::string whole;
  {
    const std::lock_guard<std::recursive_mutex> lock(s.mutex);
    appenders = s.appenders;
    whole = formatted(params);
  }
  {
    const std::lock_guard<std::mutex> lock(s.output);
    FILE* const out = level >= levels::Warn ? stderr : stdout;
    if (isatty(fileno(out))) std::fprintf(out, "%s%s\033[0m\n", kColors[level], whole.c_str());
    else std::fprintf(out, "%s\n", whole.c_str());
    std::fflush(out);
  }
  for (LogAppender* const appender : appenders) appender->log(level, params.message, file, function, line);
}

std::string expand(const char* format, va_list arguments) {
  va_list copy;
  va_copy(copy, arguments);
  const int size = std::vsnprintf(nullptr, 0, format, copy);
  va_end(copy);
  if (size < 0) return format;
  std::string text(static_cast<size_t>(size), '\0');
  std::vsnprintf(&text[0], text.size() + 1, format, arguments);
  return text;
}

}  // namespace

bool g_initialized = false;

void initialize() {
  State& s = state();
  const std::lock_guard<std::recursive_mutex> lock(s.mutex);
  if (g_initialized) return;
  if (const char* const format = std::getenv("ROSCONSOLE_FORMAT")) s.format = format;
  if (const char* const path = std::getenv("ROSCONSOLE_CONFIG_FILE")) readConfiguration(path);
  g_initialized = true;
}

void shutdown() {}

void register_appender(LogAppender* appender) {
  const std::lock_guard<std::recursive_mutex> lock(state().mutex);
  state().appenders.push_back(appender);
}

void deregister_appender(LogAppender* appender) {
  const std::lock_guard<std::recursive_mutex> lock(state().mutex);
  std::vector<LogAppender*>& all = state().appenders;
  all.erase(std::remove(all.begin(), all.end(), appender), all.end());
}

bool get_loggers(std::map<std::string, levels::Level>& loggers) {
  const std::lock_guard<std::recursive_mutex> lock(state().mutex);
  for (const auto& entry : state().loggers) loggers[entry.first] = effectiveLevel(entry.first);
  return true;
}

bool set_logger_level(const std::string& name, levels::Level level) {
  if (level < levels::Debug || level >= levels::Count) return false;
  const std::lock_guard<std::recursive_mutex> lock(state().mutex);
  find(name)->level = level;
  return true;
}

void notifyLoggerLevelsChanged() {
  const std::lock_guard<std::recursive_mutex> lock(state().mutex);
  for (LogLocation* const location : state().locations) checkLogLocationEnabled(location);
}

void initializeLogLocation(LogLocation* location, const std::string& name, levels::Level level) {
  const std::lock_guard<std::recursive_mutex> lock(state().mutex);
  if (location->initialized_) return;
  location->logger_ = find(name);
  location->level_ = level;
  state().locations.push_back(location);
  checkLogLocationEnabled(location);
  location->initialized_ = true;
}

void setLogLocationLevel(LogLocation* location, levels::Level level) {
  location->level_ = level;
  checkLogLocationEnabled(location);
}

void checkLogLocationEnabled(LogLocation* location) {
  const std::lock_guard<std::recursive_mutex> lock(state().mutex);
  location->logger_enabled_ = location->level_ >= effectiveLevel(static_cast<Logger*>(location->logger_)->name);
}

std::string formatToString(const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  const std::string text = expand(format, arguments);
  va_end(arguments);
  return text;
}

void print(FilterBase* filter, void* logger, Level level, const char* file, int line, const char* function,
           const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  const std::string text = expand(format, arguments);
  va_end(arguments);
  emit(filter, logger, level, text.c_str(), file, line, function);
}

void print(FilterBase* filter, void* logger, Level level, const std::stringstream& text, const char* file, int line,
           const char* function) {
  emit(filter, logger, level, text.str().c_str(), file, line, function);
}

void setFixedFilterToken(const std::string& key, const std::string& value) {
  const std::lock_guard<std::recursive_mutex> lock(state().mutex);
  state().tokens[key] = value;
}

bool isDue(double& last, double period, bool delayed) {
  const double now = Time::now().toSec();
  if (last < 0.0 && delayed) {
    last = now;
    return false;
  }
  if (last >= 0.0 && now >= last && now < last + period) return false;
  last = now;
  return true;
}

}  // namespace console
}  // namespace ros
