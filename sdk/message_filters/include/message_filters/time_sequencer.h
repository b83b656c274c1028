#pragma once

#include <ros/ros.h>

#include <set>
#include <vector>

#include "message_filters/simple_filter.h"

namespace message_filters {

/** Filter that passes messages on in the order of their stamps, each some time after its stamp. */
template <class M>
class TimeSequencer : public SimpleFilter<M> {
 public:
  typedef boost::shared_ptr<M const> MConstPtr;
  typedef ros::MessageEvent<M const> EventType;

  /** `queue_size`: messages that wait; the oldest is dropped. 0: no limit. */
  TimeSequencer(ros::Duration delay, ros::Duration update_rate, uint32_t queue_size,
                ros::NodeHandle nh = ros::NodeHandle())
      : delay_(delay), queue_size_(queue_size) {
    timer_ = nh.createTimer(update_rate, [this](const ros::TimerEvent&) { passOn(); });
  }
  template <class F>
  TimeSequencer(F& f, ros::Duration delay, ros::Duration update_rate, uint32_t queue_size,
                ros::NodeHandle nh = ros::NodeHandle())
      : TimeSequencer(delay, update_rate, queue_size, nh) {
    connectInput(f);
  }
  ~TimeSequencer() {
    timer_.stop();
    incoming_.disconnect();
  }

  template <class F>
  void connectInput(F& f) {
    incoming_.disconnect();
    incoming_ = f.registerCallback(typename SimpleFilter<M>::EventCallback([this](const EventType& e) { add(e); }));
  }
  void add(const MConstPtr& message) { add(EventType(message)); }
  void add(const EventType& event) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (stamp(event) < last_) return;
    events_.insert(event);
    if (queue_size_ > 0 && events_.size() > queue_size_) events_.erase(events_.begin());
  }

 private:
  static ros::Time stamp(const EventType& event) {
    return ros::message_traits::TimeStamp<M>::value(*event.getMessage());
  }
  struct Earlier {
    bool operator()(const EventType& a, const EventType& b) const { return stamp(a) < stamp(b); }
  };

  void passOn() {
    std::vector<EventType> ready;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      const double now = ros::Time::now().toSec();
      while (!events_.empty() && stamp(*events_.begin()).toSec() + delay_.toSec() <= now) {
        ready.push_back(*events_.begin());
        last_ = stamp(ready.back());
        events_.erase(events_.begin());
      }
    }
    for (const EventType& event : ready) this->signalMessage(event);
  }

  ros::Duration delay_;
  uint32_t queue_size_;
  std::mutex mutex_;
  std::multiset<EventType, Earlier> events_;
  ros::Time last_;
  ros::Timer timer_;
  Connection incoming_;
};

}  // namespace message_filters
