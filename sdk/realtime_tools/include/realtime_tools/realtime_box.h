#pragma once

#include <mutex>

namespace realtime_tools {

/** Value that several threads read and write as a whole. */
template <class T>
class RealtimeBox {
 public:
  explicit RealtimeBox(const T& initial = T()) : value_(initial) {}
  void set(const T& value) {
    const std::lock_guard<std::mutex> lock(mutex_);
    value_ = value;
  }
  void get(T& value) {
    const std::lock_guard<std::mutex> lock(mutex_);
    value = value_;
  }

 private:
  std::mutex mutex_;
  T value_;
};

}  // namespace realtime_tools
