#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <ros/ros.h>

#include <vector>

namespace tf2_ros {

/** Publishes transforms on /tf. */
class TransformBroadcaster {
 public:
  TransformBroadcaster();
  void sendTransform(const geometry_msgs::TransformStamped& transform);
  void sendTransform(const std::vector<geometry_msgs::TransformStamped>& transforms);

 private:
  ros::NodeHandle node_;
  ros::Publisher publisher_;
};

}  // namespace tf2_ros
