#pragma once

#include <filters/channels.hpp>

#include <numeric>

namespace filters {
namespace channels {

template <typename T>
class Mean : public Window<T> {
 public:
  T next(const T& value) {
    this->add(value);
    return std::accumulate(this->values_.begin(), this->values_.end(), T()) / static_cast<T>(this->values_.size());
  }
};

}  // namespace channels

/** Mean of the last values. Parameter: number_of_observations. */
template <typename T>
class MeanFilter : public channels::Single<T, channels::Mean<T> > {};
template <typename T>
class MultiChannelMeanFilter : public channels::Multi<T, channels::Mean<T> > {};

}  // namespace filters
