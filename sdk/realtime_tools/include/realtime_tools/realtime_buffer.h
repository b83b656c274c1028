#pragma once

#include <mutex>
#include <utility>

namespace realtime_tools {

/** Value that one thread writes and a real-time thread reads: the reader never waits, it gets the old value instead. */
template <class T>
class RealtimeBuffer {
 public:
  RealtimeBuffer() {}
  explicit RealtimeBuffer(const T& data) { initRT(data); }
  RealtimeBuffer(const RealtimeBuffer& other) { *this = other; }
  RealtimeBuffer& operator=(const RealtimeBuffer& other) {
    if (this == &other) return *this;
    std::unique_lock<std::mutex> theirs(other.mutex_, std::defer_lock), ours(mutex_, std::defer_lock);
    std::lock(theirs, ours);
    realtime_ = other.is_new_ ? other.written_ : other.realtime_;
    is_new_ = false;
    return *this;
  }

  /** Set the value before there are threads. */
  void initRT(const T& data) {
    const std::lock_guard<std::mutex> lock(mutex_);
    written_ = realtime_ = data;
    is_new_ = false;
  }
  T* readFromRT() {
    std::unique_lock<std::mutex> lock(mutex_, std::try_to_lock);
    if (lock.owns_lock() && is_new_) {
      std::swap(realtime_, written_);
      is_new_ = false;
    }
    return &realtime_;
  }
  /** Value as last written, for the thread that writes. */
  T* readFromNonRT() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return is_new_ ? &written_ : &realtime_;
  }
  void writeFromNonRT(const T& data) {
    const std::lock_guard<std::mutex> lock(mutex_);
    written_ = data;
    is_new_ = true;
  }

 private:
  mutable std::mutex mutex_;
  mutable T written_{}, realtime_{};
  bool is_new_ = false;
};

}  // namespace realtime_tools
