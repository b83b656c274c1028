#pragma once

#include <ros/time.h>

#include <algorithm>
#include <deque>
#include <vector>

#include "message_filters/simple_filter.h"

namespace message_filters {

/** Filter that keeps the last messages, in the order of their stamps. */
template <class M>
class Cache : public SimpleFilter<M> {
 public:
  typedef boost::shared_ptr<M const> MConstPtr;
  typedef ros::MessageEvent<M const> EventType;

  explicit Cache(unsigned int cache_size = 1) { setCacheSize(cache_size); }
  template <class F>
  explicit Cache(F& f, unsigned int cache_size = 1) {
    setCacheSize(cache_size);
    connectInput(f);
  }
  ~Cache() { incoming_.disconnect(); }

  template <class F>
  void connectInput(F& f) {
    incoming_.disconnect();
    incoming_ = f.registerCallback(typename SimpleFilter<M>::EventCallback([this](const EventType& e) { add(e); }));
  }
  void setCacheSize(unsigned int cache_size) { size_ = std::max(cache_size, 1u); }

  void add(const MConstPtr& message) { add(EventType(message)); }
  void add(const EventType& event) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      while (events_.size() >= size_) events_.pop_front();
      events_.insert(after(stamp(event)), event);
    }
    this->signalMessage(event);
  }

  /** Messages from a time up to another. */
  std::vector<MConstPtr> getInterval(const ros::Time& start, const ros::Time& end) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return messages(notBefore(start), after(end));
  }
  /** As above, with the message before them and the one after. */
  std::vector<MConstPtr> getSurroundingInterval(const ros::Time& start, const ros::Time& end) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    Iterator from = after(start), to = notBefore(end);
    if (from != events_.begin()) --from;
    if (to != events_.end()) ++to;
    return messages(from, to);
  }
  /** Last message before a time; null if there is none. */
  MConstPtr getElemBeforeTime(const ros::Time& time) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    const Iterator found = notBefore(time);
    return found == events_.begin() ? MConstPtr() : (found - 1)->getMessage();
  }
  MConstPtr getElemAfterTime(const ros::Time& time) const {
    const std::lock_guard<std::mutex> lock(mutex_);
    const Iterator found = after(time);
    return found == events_.end() ? MConstPtr() : found->getMessage();
  }
  ros::Time getLatestTime() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return events_.empty() ? ros::Time() : stamp(events_.back());
  }
  ros::Time getOldestTime() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return events_.empty() ? ros::Time() : stamp(events_.front());
  }

 private:
  typedef typename std::deque<EventType>::const_iterator Iterator;

  static ros::Time stamp(const EventType& event) {
    return ros::message_traits::TimeStamp<M>::value(*event.getMessage());
  }
  Iterator after(const ros::Time& time) const {
    return std::find_if(events_.begin(), events_.end(), [&](const EventType& e) { return stamp(e) > time; });
  }
  Iterator notBefore(const ros::Time& time) const {
    return std::find_if(events_.begin(), events_.end(), [&](const EventType& e) { return stamp(e) >= time; });
  }
  static std::vector<MConstPtr> messages(Iterator from, Iterator to) {
    std::vector<MConstPtr> result;
    for (; from < to; ++from) result.push_back(from->getMessage());
    return result;
  }

  mutable std::mutex mutex_;
  std::deque<EventType> events_;
  unsigned int size_ = 1;
  Connection incoming_;
};

}  // namespace message_filters
