#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <ros/ros.h>
#include <tf2_msgs/TFMessage.h>

#include <map>
#include <string>
#include <vector>

namespace tf2_ros {

/** Publishes transforms on /tf_static, which hold until they are sent again. */
class StaticTransformBroadcaster {
 public:
  StaticTransformBroadcaster();
  void sendTransform(const geometry_msgs::TransformStamped& transform);
  void sendTransform(const std::vector<geometry_msgs::TransformStamped>& transforms);

 private:
  ros::NodeHandle node_;
  ros::Publisher publisher_;
  std::map<std::string, geometry_msgs::TransformStamped> sent_;
};

}  // namespace tf2_ros
