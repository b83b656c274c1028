#pragma once

#include <filters/channels.hpp>

#include <algorithm>

namespace filters {
namespace channels {

template <typename T>
class Median : public Window<T> {
 public:
  /** The lower one of the two in the middle. */
  T next(const T& value) {
    this->add(value);
    sorted_ = this->values_;
    const typename std::vector<T>::iterator middle = sorted_.begin() + static_cast<std::ptrdiff_t>((sorted_.size() - 1) / 2);
    std::nth_element(sorted_.begin(), middle, sorted_.end());
    return *middle;
  }

 private:
  std::vector<T> sorted_;
};

}  // namespace channels

/** Median of the last values. Parameter: number_of_observations. */
template <typename T>
class MedianFilter : public channels::Single<T, channels::Median<T> > {};
template <typename T>
class MultiChannelMedianFilter : public channels::Multi<T, channels::Median<T> > {};

}  // namespace filters
