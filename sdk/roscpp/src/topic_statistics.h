#pragma once

#include <rosgraph_msgs/TopicStatistics.h>

#include <map>
#include <memory>
#include <mutex>
#include <string>

#include "ros/serialized_message.h"

namespace ros {

class Publication;

/** Mean, standard deviation (Welford's recurrence) and maximum of lengths of time. */
class DurationMoments {
 public:
  void add(double seconds);
  Duration mean() const;
  Duration deviation() const;
  Duration max() const;

 private:
  size_t count_ = 0;
  double mean_ = 0.0, squares_ = 0.0, max_ = 0.0;
};

/** Statistics of the messages of a subscribed topic, publisher by publisher, which go to /statistics.
 *
 * A window adapts to the messages' rate, within the parameters /statistics_window_min_elements (10), _max_elements
 * (100), _min_size (4) and _max_size (64) [s]. */
class TopicStatistics {
 public:
  /** Statistics of a topic; null unless the parameter /enable_statistics is true. Registers /statistics. */
  static std::shared_ptr<TopicStatistics> create(const std::string& topic, bool has_header);

  /** Count a message from a node, and publish at the window's end. */
  void count(const std::string& publisher, const SerializedMessage& message, bool is_dropped);

 private:
  struct Window {
    Time begin, arrival;
    double size = 1.0;
    int delivered = 0, dropped = 0;
    size_t traffic = 0;
    DurationMoments periods, ages;
  };
  TopicStatistics(const std::string& topic, bool has_header);
  void publish(const std::string& publisher, const Window& window, const Time& end) const;

  const std::string topic_;
  const bool has_header_;
  int min_elements_ = 10, max_elements_ = 100;
  double min_size_ = 4.0, max_size_ = 64.0;
  std::shared_ptr<Publication> publication_;
  std::mutex mutex_;
  std::map<std::string, Window> windows_;
};

}  // namespace ros
