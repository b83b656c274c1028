#pragma once

#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <geometry_msgs/WrenchStamped.h>
#include <tf2/convert.h>

#include <kdl/frames.hpp>

#include "kdl_conversions/kdl_msg.h"

namespace tf2 {

inline KDL::Frame transformToKDL(const geometry_msgs::TransformStamped& t) {
  KDL::Frame frame;
  tf::transformMsgToKDL(t.transform, frame);
  return frame;
}
inline geometry_msgs::TransformStamped kdlToTransform(const KDL::Frame& k) {
  geometry_msgs::TransformStamped t;
  tf::transformKDLToMsg(k, t.transform);
  return t;
}

// Vectors are points.
template <>
inline void doTransform(const tf2::Stamped<KDL::Vector>& in, tf2::Stamped<KDL::Vector>& out,
                        const geometry_msgs::TransformStamped& transform) {
  out = tf2::Stamped<KDL::Vector>(transformToKDL(transform) * in, transform.header.stamp, transform.header.frame_id);
}
inline geometry_msgs::PointStamped toMsg(const tf2::Stamped<KDL::Vector>& in) {
  geometry_msgs::PointStamped m;
  m.header.stamp = in.stamp_;
  m.header.frame_id = in.frame_id_;
  tf::pointKDLToMsg(in, m.point);
  return m;
}
inline void fromMsg(const geometry_msgs::PointStamped& m, tf2::Stamped<KDL::Vector>& out) {
  out.stamp_ = m.header.stamp;
  out.frame_id_ = m.header.frame_id;
  tf::pointMsgToKDL(m.point, out);
}

template <>
inline void doTransform(const tf2::Stamped<KDL::Twist>& in, tf2::Stamped<KDL::Twist>& out,
                        const geometry_msgs::TransformStamped& transform) {
  out = tf2::Stamped<KDL::Twist>(transformToKDL(transform) * in, transform.header.stamp, transform.header.frame_id);
}
inline geometry_msgs::TwistStamped toMsg(const tf2::Stamped<KDL::Twist>& in) {
  geometry_msgs::TwistStamped m;
  m.header.stamp = in.stamp_;
  m.header.frame_id = in.frame_id_;
  tf::twistKDLToMsg(in, m.twist);
  return m;
}
inline void fromMsg(const geometry_msgs::TwistStamped& m, tf2::Stamped<KDL::Twist>& out) {
  out.stamp_ = m.header.stamp;
  out.frame_id_ = m.header.frame_id;
  tf::twistMsgToKDL(m.twist, out);
}

template <>
inline void doTransform(const tf2::Stamped<KDL::Wrench>& in, tf2::Stamped<KDL::Wrench>& out,
                        const geometry_msgs::TransformStamped& transform) {
  out = tf2::Stamped<KDL::Wrench>(transformToKDL(transform) * in, transform.header.stamp, transform.header.frame_id);
}
inline geometry_msgs::WrenchStamped toMsg(const tf2::Stamped<KDL::Wrench>& in) {
  geometry_msgs::WrenchStamped m;
  m.header.stamp = in.stamp_;
  m.header.frame_id = in.frame_id_;
  tf::wrenchKDLToMsg(in, m.wrench);
  return m;
}
inline void fromMsg(const geometry_msgs::WrenchStamped& m, tf2::Stamped<KDL::Wrench>& out) {
  out.stamp_ = m.header.stamp;
  out.frame_id_ = m.header.frame_id;
  tf::wrenchMsgToKDL(m.wrench, out);
}

template <>
inline void doTransform(const tf2::Stamped<KDL::Frame>& in, tf2::Stamped<KDL::Frame>& out,
                        const geometry_msgs::TransformStamped& transform) {
  out = tf2::Stamped<KDL::Frame>(transformToKDL(transform) * in, transform.header.stamp, transform.header.frame_id);
}
inline geometry_msgs::Pose toMsg(const KDL::Frame& in) {
  geometry_msgs::Pose m;
  tf::poseKDLToMsg(in, m);
  return m;
}
inline void fromMsg(const geometry_msgs::Pose& m, KDL::Frame& out) { tf::poseMsgToKDL(m, out); }
inline geometry_msgs::PoseStamped toMsg(const tf2::Stamped<KDL::Frame>& in) {
  geometry_msgs::PoseStamped m;
  m.header.stamp = in.stamp_;
  m.header.frame_id = in.frame_id_;
  m.pose = toMsg(static_cast<const KDL::Frame&>(in));
  return m;
}
inline void fromMsg(const geometry_msgs::PoseStamped& m, tf2::Stamped<KDL::Frame>& out) {
  out.stamp_ = m.header.stamp;
  out.frame_id_ = m.header.frame_id;
  fromMsg(m.pose, static_cast<KDL::Frame&>(out));
}

}  // namespace tf2
