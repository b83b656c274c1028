#pragma once

#include <ros/console.h>
#include <ros/time.h>

#include <algorithm>
#include <array>
#include <deque>
#include <limits>

#include "message_filters/synchronizer.h"

namespace message_filters {
namespace sync_policies {

/** Sets of messages with stamps as close as possible: each message is in one set, and sets do not cross.
 *
 * The latest of all queues' first messages, the pivot, is in the next set. Among the sets with it, the shortest is
 * passed on, as soon as no message that is still to come can make a shorter one.
 */
template <class... M>
class ApproximateTime : public PolicyBase<M...> {
 public:
  typedef PolicyBase<M...> Base;
  typedef typename Base::Events Events;
  typedef Events Tuple;
  static const size_t kCount = Base::kCount;

  /** `queue_size`: messages of an input that wait; the oldest is dropped. */
  ApproximateTime(uint32_t queue_size) : queue_size_(queue_size) {}
  ApproximateTime(const ApproximateTime& o)
      : Base(),
        queue_size_(o.queue_size_),
        age_penalty_(o.age_penalty_),
        max_interval_(o.max_interval_),
        lower_bounds_(o.lower_bounds_) {}

  template <int i>
  void add(const typename std::tuple_element<i, Events>::type& event) {
    std::vector<Events> found;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      const int64_t stamp = static_cast<int64_t>(Base::template stamp<i>(event).toNSec());
      warnOfOrder(i, stamp);
      std::get<i>(queues_).push_back(event);
      stamps_[i].push_back(stamp);
      search(found);
      if (queue_size_ > 0 && stamps_[i].size() > queue_size_) {
        pop(i, 1);
        has_dropped_[i] = true;
        search(found);
      }
    }
    for (const Events& events : found) this->signal(events);
  }

  /** How much a later set has to be shorter than an earlier one, as a factor of its delay. */
  void setAgePenalty(double age_penalty) { age_penalty_ = age_penalty; }
  /** Least time between two messages of an input, by which sets are known to be the shortest sooner. */
  void setInterMessageLowerBound(int i, ros::Duration lower_bound) { lower_bounds_.at(i) = lower_bound.toNSec(); }
  void setInterMessageLowerBound(ros::Duration lower_bound) { lower_bounds_.fill(lower_bound.toNSec()); }
  /** Longest time from the first to the last stamp of a set. */
  void setMaxIntervalDuration(ros::Duration max_interval_duration) { max_interval_ = max_interval_duration.toNSec(); }

 private:
  typedef std::array<size_t, kCount> Cursors;
  /** Stamps of a set's first and last message [ns], and their inputs. */
  struct Span {
    int64_t start, end;
    size_t first, last;
  };

  /** Find all sets that are certain by now. */
  void search(std::vector<Events>& found) {
    while (std::none_of(stamps_.begin(), stamps_.end(), [](const std::deque<int64_t>& q) { return q.empty(); })) {
      Cursors best{};
      const Span heads = span(best, 0);
      for (size_t i = 0; i < kCount; ++i)
        if (i != heads.last) has_dropped_[i] = false;
      // A message whose predecessors were dropped may belong to one of those: it is no pivot.
      if (heads.end - heads.start > max_interval_ || has_dropped_[heads.last]) {
        pop(heads.first, 1);
        continue;
      }
      if (!findShortest(heads, best)) return;
      found.push_back(take(best, typename IndicesUpTo<kCount>::type()));
    }
  }

  /** Find the shortest set with the pivot; false if that depends on messages to come. */
  bool findShortest(const Span& heads, Cursors& best) const {
    const size_t pivot = heads.last;
    const int64_t pivot_time = heads.end;
    Span shortest = heads, now = heads;
    Cursors at{};
    while (true) {
      bool is_known = true;
      for (size_t i = 0; i < kCount; ++i) is_known = is_known && at[i] < stamps_[i].size();
      if (penalized(now.end - shortest.end) < static_cast<double>(now.start - shortest.start)) {
        if (!is_known) return false;
        shortest = now;
        best = at;
      }
      const double possible_gain = static_cast<double>(pivot_time - shortest.start);
      if (now.first == pivot || penalized(now.end - shortest.end) >= possible_gain) return true;
      if (at[now.first] == stamps_[now.first].size()) return false;
      ++at[now.first];
      now = span(at, pivot_time);
    }
  }

  /** Span of a set; a message to come is, at best, at the pivot, or as early as its lower bound lets it be. */
  Span span(const Cursors& at, int64_t pivot_time) const {
    Span result{0, 0, 0, 0};
    for (size_t i = 0; i < kCount; ++i) {
      const std::deque<int64_t>& queue = stamps_[i];
      const int64_t stamp = at[i] < queue.size() ? queue[at[i]] : std::max(pivot_time, queue.back() + lower_bounds_[i]);
      if (i == 0 || stamp < result.start) {
        result.start = stamp;
        result.first = i;
      }
      if (i == 0 || stamp > result.end) {
        result.end = stamp;
        result.last = i;
      }
    }
    return result;
  }

  double penalized(int64_t delay) const { return static_cast<double>(delay) * (1.0 + age_penalty_); }

  /** Take a set, and drop the messages before it. */
  template <size_t... i>
  Events take(const Cursors& at, Indices<i...>) {
    const Events events(std::get<i>(queues_)[at[i]]...);
    for (size_t k = 0; k < kCount; ++k) pop(k, at[k] + 1);
    return events;
  }

  void pop(size_t input, size_t count) {
    stamps_[input].erase(stamps_[input].begin(), stamps_[input].begin() + count);
    popEvents(input, count, typename IndicesUpTo<kCount>::type());
  }
  template <size_t... i>
  void popEvents(size_t input, size_t count, Indices<i...>) {
    const bool done[] = {(i == input && (erase(std::get<i>(queues_), count), true))...};
    (void)done;
  }
  template <class Queue>
  static void erase(Queue& queue, size_t count) {
    queue.erase(queue.begin(), queue.begin() + count);
  }

  void warnOfOrder(size_t i, int64_t stamp) {
    if (stamps_[i].empty() || has_warned_[i]) return;
    const int64_t before = stamps_[i].back();
    if (stamp < before)
      ROS_WARN("Messages of type %d arrived out of order (will print only once)", static_cast<int>(i));
    else if (stamp - before < lower_bounds_[i])
      ROS_WARN(
          "Messages of type %d arrived closer (%f s) than the lower bound you provided (%f s) (will print only once)",
          static_cast<int>(i), 1e-9 * static_cast<double>(stamp - before),
          1e-9 * static_cast<double>(lower_bounds_[i]));
    else return;
    has_warned_[i] = true;
  }

  uint32_t queue_size_;
  double age_penalty_ = 0.1;
  int64_t max_interval_ = std::numeric_limits<int64_t>::max();
  std::array<int64_t, kCount> lower_bounds_{};
  std::array<bool, kCount> has_dropped_{}, has_warned_{};
  std::mutex mutex_;
  std::tuple<std::deque<ros::MessageEvent<M const> >...> queues_;
  std::array<std::deque<int64_t>, kCount> stamps_;
};

}  // namespace sync_policies
}  // namespace message_filters
