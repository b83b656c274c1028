/** What the standard filters share: a filter of one channel, or of several alike. */
#pragma once

#include <filters/filter_base.hpp>

namespace filters {
namespace channels {

/** A filter whose parameters a channel reads. */
template <class Base>
class Configurable : public Base {
 public:
  template <class Value>
  bool get(const std::string& name, Value& value) const {
    if (this->getParam(name, value)) return true;
    ROS_ERROR("Filter %s needs the parameter %s", this->getName().c_str(), name.c_str());
    return false;
  }
};

/** `Channel` has read(filter), which is false for wrong parameters, and next(value). */
template <typename T, class Channel>
class Single : public Configurable<FilterBase<T> > {
 public:
  virtual bool configure() {
    channel_ = Channel();
    return channel_.read(*this);
  }
  virtual bool update(const T& data_in, T& data_out) {
    if (!this->configured_) return false;
    data_out = channel_.next(data_in);
    return true;
  }

 private:
  Channel channel_;
};

template <typename T, class Channel>
class Multi : public Configurable<MultiChannelFilterBase<T> > {
 public:
  virtual bool configure() {
    Channel channel;
    if (!channel.read(*this)) return false;
    channels_.assign(this->number_of_channels_, channel);
    return true;
  }
  using MultiChannelFilterBase<T>::configure;
  virtual bool update(const std::vector<T>& data_in, std::vector<T>& data_out) {
    if (!this->configured_) return false;
    if (data_in.size() != channels_.size() || data_out.size() != channels_.size()) {
      ROS_ERROR("Filter %s has %zu channels, and got %zu values in and %zu out", this->getName().c_str(),
                channels_.size(), data_in.size(), data_out.size());
      return false;
    }
    for (std::size_t i = 0; i < channels_.size(); ++i) data_out[i] = channels_[i].next(data_in[i]);
    return true;
  }
  using MultiChannelFilterBase<T>::update;

 private:
  std::vector<Channel> channels_;
};

/** Last `number_of_observations` values. */
template <typename T>
class Window {
 public:
  template <class Filter>
  bool read(const Filter& filter) {
    int size = 0;
    if (!filter.get("number_of_observations", size)) return false;
    if (size < 1) {
      ROS_ERROR("number_of_observations of filter %s must be at least 1, got %d", filter.getName().c_str(), size);
      return false;
    }
    size_ = static_cast<std::size_t>(size);
    return true;
  }

 protected:
  void add(const T& value) {
    if (values_.size() < size_) {
      values_.push_back(value);
    } else {
      values_[oldest_] = value;
      oldest_ = (oldest_ + 1) % size_;
    }
  }
  std::vector<T> values_;

 private:
  std::size_t size_ = 0, oldest_ = 0;
};

}  // namespace channels
}  // namespace filters
