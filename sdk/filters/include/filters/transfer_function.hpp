#pragma once

#include <filters/channels.hpp>

namespace filters {
namespace channels {

template <typename T>
class TransferFunction {
 public:
  template <class Filter>
  bool read(const Filter& filter) {
    if (!filter.get("a", a_) || !filter.get("b", b_)) return false;
    if (a_.empty() || b_.empty() || a_[0] == 0.0) {
      ROS_ERROR("a and b of filter %s must not be empty, and a[0] not 0", filter.getName().c_str());
      return false;
    }
    for (double& factor : b_) factor /= a_[0];
    for (std::size_t i = a_.size(); i-- > 0;) a_[i] /= a_[0];
    in_.assign(b_.size(), T());
    out_.assign(a_.size(), T());
    return true;
  }
  T next(const T& value) {
    shift(in_);
    in_[0] = value;
    shift(out_);
    T sum = T();
    for (std::size_t i = 0; i < b_.size(); ++i) sum += static_cast<T>(b_[i]) * in_[i];
    for (std::size_t i = 1; i < a_.size(); ++i) sum -= static_cast<T>(a_[i]) * out_[i];
    return out_[0] = sum;
  }

 private:
  static void shift(std::vector<T>& values) {
    for (std::size_t i = values.size(); i-- > 1;) values[i] = values[i - 1];
  }
  std::vector<double> a_, b_;
  std::vector<T> in_, out_;
};

}  // namespace channels

/** a[0] y[n] = b[0] x[n] + b[1] x[n-1] + … - a[1] y[n-1] - …, with zeros before the first. Parameters: a, b. */
template <typename T>
class SingleChannelTransferFunctionFilter : public channels::Single<T, channels::TransferFunction<T> > {};
template <typename T>
class MultiChannelTransferFunctionFilter : public channels::Multi<T, channels::TransferFunction<T> > {};

}  // namespace filters
