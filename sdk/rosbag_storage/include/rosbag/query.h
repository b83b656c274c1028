#pragma once

#include <boost/function.hpp>
#include <string>
#include <vector>

#include "rosbag/structures.h"

namespace rosbag {

/** Chooses connections by their topics. */
class TopicQuery {
 public:
  explicit TopicQuery(const std::string& topic) : topics_(1, topic) {}
  explicit TopicQuery(const std::vector<std::string>& topics) : topics_(topics) {}
  bool operator()(const ConnectionInfo* connection) const;

 private:
  std::vector<std::string> topics_;
};

/** Chooses connections by the types of their messages. */
class TypeQuery {
 public:
  explicit TypeQuery(const std::string& type) : types_(1, type) {}
  explicit TypeQuery(const std::vector<std::string>& types) : types_(types) {}
  bool operator()(const ConnectionInfo* connection) const;

 private:
  std::vector<std::string> types_;
};

}  // namespace rosbag
