#pragma once

#include <ros/ros.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/FrameGraph.h>

#include "tf2_ros/buffer_interface.h"

namespace tf2_ros {

/** What is said of a timeout in the thread that would have to set the transforms. */
const std::string threading_error =
    "a timeout needs another thread that sets transforms: a TransformListener with spin_thread = true, or one of "
    "yours after setUsingDedicatedThread(true)";

/** Frames of the graph, filled by a TransformListener.

With a timeout, canTransform is false at once, and lookupTransform does not wait, if no other thread is announced. */
class Buffer : public BufferInterface, public tf2::BufferCore {
 public:
  using tf2::BufferCore::canTransform;
  using tf2::BufferCore::lookupTransform;

  explicit Buffer(ros::Duration cache_time = ros::Duration(BufferCore::DEFAULT_CACHE_TIME), bool debug = false)
      : BufferCore(cache_time) {
    (void)debug;
  }
  geometry_msgs::TransformStamped lookupTransform(const std::string& target_frame, const std::string& source_frame,
                                                  const ros::Time& time, const ros::Duration timeout) const override;
  geometry_msgs::TransformStamped lookupTransform(const std::string& target_frame, const ros::Time& target_time,
                                                  const std::string& source_frame, const ros::Time& source_time,
                                                  const std::string& fixed_frame,
                                                  const ros::Duration timeout) const override;
  bool canTransform(const std::string& target_frame, const std::string& source_frame, const ros::Time& time,
                    const ros::Duration timeout, std::string* errstr = nullptr) const override;
  bool canTransform(const std::string& target_frame, const ros::Time& target_time, const std::string& source_frame,
                    const ros::Time& source_time, const std::string& fixed_frame, const ros::Duration timeout,
                    std::string* errstr = nullptr) const override;
};

}  // namespace tf2_ros
