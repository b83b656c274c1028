#pragma once

#include <ros/ros.h>
#include <std_msgs/Empty.h>
#include <tf/tfMessage.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <string>
#include <vector>

#include "tf/tf.h"

namespace tf {

/** Transforms of the last seconds; time 0 is the latest time. */
class Transformer {
 public:
  explicit Transformer(bool interpolating = true, ros::Duration cache_time = ros::Duration(10.0));
  virtual ~Transformer() {}

  void clear() { buffer_->clear(); }
  // Nothing is extrapolated, with any limit, as in tf since it is built on tf2.
  void setExtrapolationLimit(const ros::Duration&) {}
  bool setTransform(const StampedTransform& transform, const std::string& authority = "default_authority");
  void lookupTransform(const std::string& target_frame, const std::string& source_frame, const ros::Time& time,
                       StampedTransform& transform) const;
  void lookupTransform(const std::string& target_frame, const ros::Time& target_time, const std::string& source_frame,
                       const ros::Time& source_time, const std::string& fixed_frame, StampedTransform& transform) const;
  /** Wait until a transform is known; false at the timeout. */
  bool waitForTransform(const std::string& target_frame, const std::string& source_frame, const ros::Time& time,
                        const ros::Duration& timeout, const ros::Duration& polling_sleep_duration = ros::Duration(0.01),
                        std::string* error_msg = nullptr) const;
  bool canTransform(const std::string& target_frame, const std::string& source_frame, const ros::Time& time,
                    std::string* error_msg = nullptr) const;
  bool waitForTransform(const std::string& target_frame, const ros::Time& target_time, const std::string& source_frame,
                        const ros::Time& source_time, const std::string& fixed_frame, const ros::Duration& timeout,
                        const ros::Duration& polling_sleep_duration = ros::Duration(0.01),
                        std::string* error_msg = nullptr) const;
  /** Time of the latest transform between two frames; 0 if there is none. */
  int getLatestCommonTime(const std::string& source_frame, const std::string& target_frame, ros::Time& time,
                          std::string* error_string = nullptr) const;
  bool frameExists(const std::string& frame_id) const { return buffer_->frameExists(frame_id); }
  bool getParent(const std::string& frame_id, ros::Time time, std::string& parent) const {
    return buffer_->getParent(frame_id, time, parent);
  }
  void getFrameStrings(std::vector<std::string>& ids) const { buffer_->getFrameStrings(ids); }
  std::string allFramesAsString() const { return buffer_->allFramesAsString(); }
  ros::Duration getCacheLength() const { return buffer_->getCacheLength(); }
  boost::shared_ptr<tf2_ros::Buffer> getTF2BufferPtr() { return buffer_; }

  void transformQuaternion(const std::string& target_frame, const Stamped<Quaternion>& in,
                           Stamped<Quaternion>& out) const;
  void transformVector(const std::string& target_frame, const Stamped<Vector3>& in, Stamped<Vector3>& out) const;
  void transformPoint(const std::string& target_frame, const Stamped<Point>& in, Stamped<Point>& out, int = 0) const;
  void transformPose(const std::string& target_frame, const Stamped<Pose>& in, Stamped<Pose>& out) const;

 protected:
  boost::shared_ptr<tf2_ros::Buffer> buffer_;
};

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
