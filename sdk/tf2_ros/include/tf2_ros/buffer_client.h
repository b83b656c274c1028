#pragma once

#include <actionlib/client/simple_action_client.h>
#include <tf2_msgs/LookupTransformAction.h>

#include <string>

#include "tf2_ros/buffer_interface.h"

namespace tf2_ros {

/** Frames of a BufferServer, for programs that do not follow them. */
class BufferClient : public BufferInterface {
 public:
  typedef actionlib::SimpleActionClient<tf2_msgs::LookupTransformAction> LookupActionClient;

  /** An answer is awaited for the timeout of the lookup and `timeout_padding` more. */
  explicit BufferClient(std::string ns, double check_frequency = 10.0,
                        ros::Duration timeout_padding = ros::Duration(2.0));

  geometry_msgs::TransformStamped lookupTransform(const std::string& target_frame, const std::string& source_frame,
                                                  const ros::Time& time,
                                                  const ros::Duration timeout = ros::Duration(0.0)) const override;
  geometry_msgs::TransformStamped lookupTransform(const std::string& target_frame, const ros::Time& target_time,
                                                  const std::string& source_frame, const ros::Time& source_time,
                                                  const std::string& fixed_frame,
                                                  const ros::Duration timeout = ros::Duration(0.0)) const override;
  bool canTransform(const std::string& target_frame, const std::string& source_frame, const ros::Time& time,
                    const ros::Duration timeout = ros::Duration(0.0), std::string* errstr = nullptr) const override;
  bool canTransform(const std::string& target_frame, const ros::Time& target_time, const std::string& source_frame,
                    const ros::Time& source_time, const std::string& fixed_frame,
                    const ros::Duration timeout = ros::Duration(0.0), std::string* errstr = nullptr) const override;
  bool waitForServer(const ros::Duration& timeout = ros::Duration(0)) { return client_.waitForServer(timeout); }

 private:
  geometry_msgs::TransformStamped ask(const tf2_msgs::LookupTransformGoal& goal) const;

  mutable LookupActionClient client_;
  ros::Duration timeout_padding_;
};

}  // namespace tf2_ros
