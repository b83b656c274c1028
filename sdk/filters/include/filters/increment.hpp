#pragma once

#include <filters/channels.hpp>

namespace filters {
namespace channels {

template <typename T>
class Increment {
 public:
  template <class Filter>
  bool read(const Filter&) {
    return true;
  }
  T next(const T& value) { return value + 1; }
};

}  // namespace channels

/** One more than the value; for tests. */
template <typename T>
class IncrementFilter : public channels::Single<T, channels::Increment<T> > {};
template <typename T>
class MultiChannelIncrementFilter : public channels::Multi<T, channels::Increment<T> > {};

}  // namespace filters
