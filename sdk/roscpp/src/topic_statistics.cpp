#include "topic_statistics.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "ros/param.h"
#include "ros/this_node.h"
#include "topics.h"

namespace ros {
namespace {

const char* const kTopic = "/statistics";

/** Of a publisher that does not ask who subscribes. */
const boost::shared_ptr<Publication::Callbacks>& noCallbacks() {
  static const auto* const callbacks =
      new boost::shared_ptr<Publication::Callbacks>(boost::make_shared<Publication::Callbacks>());
  return *callbacks;
}

/** A stamp may be of another century: a Duration has 32 bits of seconds. */
Duration bounded(double seconds) { return Duration(std::clamp(seconds, -2e9, 2e9)); }

}  // namespace

void DurationMoments::add(double seconds) {
  max_ = count_ == 0 ? seconds : std::max(max_, seconds);
  const double difference = seconds - mean_;
  mean_ += difference / static_cast<double>(++count_);
  squares_ += difference * (seconds - mean_);
}

Duration DurationMoments::mean() const { return bounded(mean_); }
Duration DurationMoments::deviation() const {
  return bounded(count_ > 0 ? std::sqrt(squares_ / static_cast<double>(count_)) : 0.0);
}
Duration DurationMoments::max() const { return bounded(max_); }

std::shared_ptr<TopicStatistics> TopicStatistics::create(const std::string& topic, bool has_header) {
  bool is_enabled = false;
  if (topic == kTopic || topic == "/clock" || !param::get("/enable_statistics", is_enabled) || !is_enabled)
    return nullptr;
  return std::shared_ptr<TopicStatistics>(new TopicStatistics(topic, has_header));
}

TopicStatistics::TopicStatistics(const std::string& topic, bool has_header) : topic_(topic), has_header_(has_header) {
  param::get("/statistics_window_min_elements", min_elements_);
  param::get("/statistics_window_max_elements", max_elements_);
  param::get("/statistics_window_min_size", min_size_);
  param::get("/statistics_window_max_size", max_size_);
  publication_ = topics::publication(kTopic);
  if (publication_) return;
  AdvertiseOptions options;
  options.init<rosgraph_msgs::TopicStatistics>(kTopic, 10);
  publication_ = topics::advertise(options, noCallbacks());
}

void TopicStatistics::count(const std::string& publisher, const SerializedMessage& message, bool is_dropped) {
  const Time now = Time::now();
  Window ended;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    Window& window = windows_[publisher];
    if (window.begin.isZero()) window.begin = now;
    ++window.delivered;
    window.dropped += is_dropped;
    window.traffic += message.num_bytes;
    if (!window.arrival.isZero()) window.periods.add(now.toSec() - window.arrival.toSec());
    window.arrival = now;
    const size_t start = message.buf ? static_cast<size_t>(message.message_start - message.buf.get()) : 0;
    uint32_t header[3];  // number, seconds, nanoseconds
    if (has_header_ && message.buf && message.num_bytes >= start + sizeof(header)) {
      std::memcpy(header, message.message_start, sizeof(header));
      window.ages.add(now.toSec() - (header[1] + 1e-9 * header[2]));
    }
    if (now.toSec() - window.begin.toSec() < window.size) return;
    ended = window;
    window = Window();
    window.begin = now;
    window.size = ended.size;
    if (ended.delivered > max_elements_ && ended.size / 2.0 >= min_size_) window.size /= 2.0;
    if (ended.delivered < min_elements_ && ended.size * 2.0 <= max_size_) window.size *= 2.0;
  }
  publish(publisher, ended, now);
}

void TopicStatistics::publish(const std::string& publisher, const Window& window, const Time& end) const {
  if (!publication_) return;
  rosgraph_msgs::TopicStatistics message;
  message.topic = topic_;
  message.node_pub = publisher;
  message.node_sub = this_node::getName();
  message.window_start = window.begin;
  message.window_stop = end;
  message.delivered_msgs = window.delivered;
  message.dropped_msgs = window.dropped;
  message.traffic = static_cast<int32_t>(std::min<size_t>(window.traffic, std::numeric_limits<int32_t>::max()));
  message.period_mean = window.periods.mean();
  message.period_stddev = window.periods.deviation();
  message.period_max = window.periods.max();
  message.stamp_age_mean = window.ages.mean();
  message.stamp_age_stddev = window.ages.deviation();
  message.stamp_age_max = window.ages.max();
  SerializedMessage bytes;
  publication_->publish(noCallbacks(), [&message] { return serialization::serializeMessage(message); }, bytes);
}

}  // namespace ros
