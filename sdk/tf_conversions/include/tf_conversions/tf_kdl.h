#pragma once

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Twist.h>
#include <tf/transform_datatypes.h>

#include <kdl/frames.hpp>

#include "kdl_conversions/kdl_msg.h"

namespace tf {

inline void vectorTFToKDL(const tf::Vector3& t, KDL::Vector& k) { k = KDL::Vector(t.x(), t.y(), t.z()); }
inline void vectorKDLToTF(const KDL::Vector& k, tf::Vector3& t) { t = tf::Vector3(k.x(), k.y(), k.z()); }
inline void quaternionTFToKDL(const tf::Quaternion& t, KDL::Rotation& k) {
  k = KDL::Rotation::Quaternion(t.x(), t.y(), t.z(), t.w());
}
inline void quaternionKDLToTF(const KDL::Rotation& k, tf::Quaternion& t) {
  double x, y, z, w;
  k.GetQuaternion(x, y, z, w);
  t = tf::Quaternion(x, y, z, w);
}
inline void transformTFToKDL(const tf::Transform& t, KDL::Frame& k) {
  vectorTFToKDL(t.getOrigin(), k.p);
  quaternionTFToKDL(t.getRotation(), k.M);
}
inline void transformKDLToTF(const KDL::Frame& k, tf::Transform& t) {
  tf::Vector3 origin;
  tf::Quaternion rotation;
  vectorKDLToTF(k.p, origin);
  quaternionKDLToTF(k.M, rotation);
  t = tf::Transform(rotation, origin);
}
inline void poseTFToKDL(const tf::Pose& t, KDL::Frame& k) { transformTFToKDL(t, k); }
inline void poseKDLToTF(const KDL::Frame& k, tf::Pose& t) { transformKDLToTF(k, t); }

/** Pose after moving by a twist for a time [s]; the twist is in the pose's reference frame. */
inline geometry_msgs::Pose addDelta(const geometry_msgs::Pose& pose, const geometry_msgs::Twist& twist,
                                    const double& t) {
  geometry_msgs::Pose result;
  KDL::Frame frame;
  KDL::Twist motion;
  poseMsgToKDL(pose, frame);
  twistMsgToKDL(twist, motion);
  poseKDLToMsg(KDL::addDelta(frame, motion, t), result);
  return result;
}

}  // namespace tf
