#pragma once

#include <ros/ros.h>
#include <sensor_msgs/PointCloud.h>
#include <std_msgs/Empty.h>
#include <tf/tfMessage.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <string>
#include <vector>

#include "tf/tf.h"

namespace tf {

/** Transformer that receives /tf and /tf_static. */
class TransformListener : public Transformer {
 public:
  explicit TransformListener(ros::Duration max_cache_time = ros::Duration(10.0), bool spin_thread = true);
  TransformListener(const ros::NodeHandle& nh, ros::Duration max_cache_time = ros::Duration(10.0),
                    bool spin_thread = true);

  using Transformer::transformPoint;
  using Transformer::transformPose;
  using Transformer::transformQuaternion;
  using Transformer::transformVector;
  void transformQuaternion(const std::string& target_frame, const geometry_msgs::QuaternionStamped& in,
                           geometry_msgs::QuaternionStamped& out) const;
  void transformVector(const std::string& target_frame, const geometry_msgs::Vector3Stamped& in,
                       geometry_msgs::Vector3Stamped& out) const;
  void transformPoint(const std::string& target_frame, const geometry_msgs::PointStamped& in,
                      geometry_msgs::PointStamped& out) const;
  void transformPose(const std::string& target_frame, const geometry_msgs::PoseStamped& in,
                     geometry_msgs::PoseStamped& out) const;
  /** Transform the points; the channels stay. */
  void transformPointCloud(const std::string& target_frame, const sensor_msgs::PointCloud& in,
                           sensor_msgs::PointCloud& out) const;

  /** Transform from the time of `in` to another time; the fixed frame is where both are related. */
  void transformQuaternion(const std::string& target_frame, const ros::Time& target_time,
                           const geometry_msgs::QuaternionStamped& in, const std::string& fixed_frame,
                           geometry_msgs::QuaternionStamped& out) const;
  void transformVector(const std::string& target_frame, const ros::Time& target_time,
                       const geometry_msgs::Vector3Stamped& in, const std::string& fixed_frame,
                       geometry_msgs::Vector3Stamped& out) const;
  void transformPoint(const std::string& target_frame, const ros::Time& target_time,
                      const geometry_msgs::PointStamped& in, const std::string& fixed_frame,
                      geometry_msgs::PointStamped& out) const;
  void transformPose(const std::string& target_frame, const ros::Time& target_time,
                     const geometry_msgs::PoseStamped& in, const std::string& fixed_frame,
                     geometry_msgs::PoseStamped& out) const;
  void transformPointCloud(const std::string& target_frame, const ros::Time& target_time,
                           const sensor_msgs::PointCloud& in, const std::string& fixed_frame,
                           sensor_msgs::PointCloud& out) const;
  /** Name of a frame with the prefix of the parameter tf_prefix. */
  std::string resolve(const std::string& frame_name) { return tf::resolve(prefix_, frame_name); }

 private:
  void readPrefix();
  tf2_ros::TransformListener listener_;
  std::string prefix_;
};

/** Parameter tf_prefix of a namespace, or of the nearest one above that has it; "" if none has. */
inline std::string getPrefixParam(ros::NodeHandle& nh) {
  std::string key, prefix;
  if (nh.searchParam("tf_prefix", key)) nh.getParam(key, prefix);
  return prefix;
}

}  // namespace tf
