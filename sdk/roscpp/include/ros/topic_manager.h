#pragma once

#include <boost/shared_ptr.hpp>
#include <cstddef>
#include <string>

#include "ros/forwards.h"

namespace ros {

class TopicManager;
typedef boost::shared_ptr<TopicManager> TopicManagerPtr;

/** Topics that the node publishes and subscribes to, by their resolved names. */
class TopicManager {
 public:
  static const TopicManagerPtr& instance();

  void getAdvertisedTopics(V_string& topics);
  void getSubscribedTopics(V_string& topics);
  /** Subscribers of a topic that is published here; publishers of one that is subscribed to. */
  size_t getNumSubscribers(const std::string& topic);
  size_t getNumPublishers(const std::string& topic);
  bool isLatched(const std::string& topic);
};

}  // namespace ros
