#pragma once

#include <diagnostic_msgs/DiagnosticStatus.h>

#include <cstdarg>
#include <cstdio>
#include <sstream>
#include <string>

namespace diagnostic_updater {

/** Status with functions that fill it. */
class DiagnosticStatusWrapper : public diagnostic_msgs::DiagnosticStatus {
 public:
  void summary(unsigned char lvl, const std::string s) {
    level = static_cast<level_type>(lvl);
    message = s;
  }
  void summary(const diagnostic_msgs::DiagnosticStatus& src) {
    summary(static_cast<unsigned char>(src.level), src.message);
  }
  void summaryf(unsigned char lvl, const char* format, ...) __attribute__((format(printf, 3, 4))) {
    va_list arguments;
    va_start(arguments, format);
    summary(lvl, formatted(format, arguments));
    va_end(arguments);
  }
  void clearSummary() { summary(0, ""); }
  /** Take the worse level, and both messages if both are bad or both are good. */
  void mergeSummary(unsigned char lvl, const std::string s) {
    if ((lvl > 0) == (level > 0)) {
      if (!message.empty()) message += "; ";
      message += s;
    } else if (lvl > static_cast<unsigned char>(level)) {
      message = s;
    }
    if (lvl > static_cast<unsigned char>(level)) level = static_cast<level_type>(lvl);
  }
  void mergeSummary(const diagnostic_msgs::DiagnosticStatus& src) {
    mergeSummary(static_cast<unsigned char>(src.level), src.message);
  }
  void mergeSummaryf(unsigned char lvl, const char* format, ...) __attribute__((format(printf, 3, 4))) {
    va_list arguments;
    va_start(arguments, format);
    mergeSummary(lvl, formatted(format, arguments));
    va_end(arguments);
  }

  template <class T>
  void add(const std::string& key, const T& value) {
    std::stringstream text;
    text << value;
    put(key, text.str());
  }
  void add(const std::string& key, const bool& value) { put(key, value ? "True" : "False"); }
  void addf(const std::string& key, const char* format, ...) __attribute__((format(printf, 3, 4))) {
    va_list arguments;
    va_start(arguments, format);
    put(key, formatted(format, arguments));
    va_end(arguments);
  }
  void clear() { values.clear(); }

 private:
  typedef diagnostic_msgs::DiagnosticStatus::_level_type level_type;

  static std::string formatted(const char* format, va_list arguments) {
    char text[1000];
    std::vsnprintf(text, sizeof text, format, arguments);
    return text;
  }
  void put(const std::string& key, const std::string& value) {
    diagnostic_msgs::KeyValue pair;
    pair.key = key;
    pair.value = value;
    values.push_back(pair);
  }
};

}  // namespace diagnostic_updater
