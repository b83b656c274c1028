#pragma once

#include <algorithm>
#include <boost/circular_buffer.hpp>

namespace filters {

/** Circular buffer whose memory is there from the start; it has a size of its own until it is full. */
template <typename T>
class RealtimeCircularBuffer {
 public:
  RealtimeCircularBuffer(int size, const T& default_val) : filled_(0), values_(size, default_val) {}

  void push_back(const T& item) {
    if (filled_ < values_.size())
      values_[filled_++] = item;
    else if (!values_.empty())
      values_.push_back(item);
  }
  void push_front(const T& item) {
    if (values_.empty()) return;
    values_.push_front(item);
    filled_ = std::min(filled_ + 1, values_.size());
  }
  void clear() { filled_ = 0; }
  void set_capacity(unsigned int order, const T& value) {
    values_.set_capacity(order);
    values_.resize(order, value);
    filled_ = std::min<std::size_t>(filled_, order);
  }
  T& front() { return values_.front(); }
  T& back() { return values_[filled_ == 0 ? 0 : filled_ - 1]; }
  unsigned int size() { return static_cast<unsigned int>(filled_); }
  bool empty() { return values_.empty(); }
  T& at(std::size_t index) { return values_.at(index); }
  T& operator[](std::size_t index) { return values_[index]; }

 private:
  std::size_t filled_;
  boost::circular_buffer<T> values_;
};

}  // namespace filters
