#pragma once

#include <tf/tfMessage.h>
#include <tf2_ros/transform_broadcaster.h>

#include <vector>

#include "tf/tf.h"

namespace tf {

/** Publishes transforms on /tf. */
class TransformBroadcaster {
 public:
  void sendTransform(const StampedTransform& transform);
  void sendTransform(const std::vector<StampedTransform>& transforms);
  void sendTransform(const geometry_msgs::TransformStamped& transform) { broadcaster_.sendTransform(transform); }
  void sendTransform(const std::vector<geometry_msgs::TransformStamped>& transforms) {
    broadcaster_.sendTransform(transforms);
  }

 private:
  tf2_ros::TransformBroadcaster broadcaster_;
};

}  // namespace tf
