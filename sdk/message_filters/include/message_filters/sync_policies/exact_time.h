#pragma once

#include <ros/time.h>

#include <map>
#include <memory>

#include "message_filters/synchronizer.h"

namespace message_filters {
namespace sync_policies {

/** Sets of messages with the same stamp. */
template <class... M>
class ExactTime : public PolicyBase<M...> {
 public:
  typedef PolicyBase<M...> Base;
  typedef typename Base::Events Events;
  typedef Events Tuple;

  /** `queue_size`: stamps that wait for their other messages; the oldest is dropped. 0: no limit. */
  ExactTime(uint32_t queue_size) : queue_size_(queue_size) {}
  ExactTime(const ExactTime& other) : Base(), queue_size_(other.queue_size_) {}

  template <int i>
  void add(const typename std::tuple_element<i, Events>::type& event) {
    Events complete;
    {
      std::unique_lock<std::mutex> lock(mutex_);
      const ros::Time stamp = Base::template stamp<i>(event);
      Set& set = sets_[stamp];
      std::get<i>(set.events) = event;
      set.has |= 1u << i;
      if (set.has != (1u << Base::kCount) - 1) {
        dropOldest(lock);
        return;
      }
      complete = set.events;
      Dropped dropped;
      const auto end = sets_.upper_bound(stamp);
      for (auto old = sets_.begin(); old != end; ++old)
        if (old->first != stamp) dropped.push_back(old->second.events);
      sets_.erase(sets_.begin(), end);
      lock.unlock();
      for (const Events& events : dropped) drops_.call(events);
    }
    this->signal(complete);
  }

  /** Connect a callback for sets that never became complete; what lacks is null. */
  template <class C>
  Connection registerDropCallback(const C& callback) {
    return drops_.addCallback(callback);
  }
  template <class C, class T>
  Connection registerDropCallback(C callback, T* object) {
    return drops_.addCallback(callback, object);
  }

 private:
  struct Set {
    Events events;
    unsigned has = 0;
  };
  typedef std::vector<Events> Dropped;

  void dropOldest(std::unique_lock<std::mutex>& lock) {
    Dropped dropped;
    while (queue_size_ > 0 && sets_.size() > queue_size_) {
      dropped.push_back(sets_.begin()->second.events);
      sets_.erase(sets_.begin());
    }
    lock.unlock();
    for (const Events& events : dropped) drops_.call(events);
  }

  uint32_t queue_size_;
  std::mutex mutex_;
  std::map<ros::Time, Set> sets_;
  Signal<M...> drops_;
};

}  // namespace sync_policies
}  // namespace message_filters
