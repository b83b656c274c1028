#pragma once

#include <geometry_msgs/Point.h>
#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Quaternion.h>
#include <geometry_msgs/Transform.h>
#include <geometry_msgs/Twist.h>
#include <geometry_msgs/Vector3.h>
#include <geometry_msgs/Wrench.h>

#include <kdl/frames.hpp>

namespace tf {

inline void pointMsgToKDL(const geometry_msgs::Point& m, KDL::Vector& k) { k = KDL::Vector(m.x, m.y, m.z); }
inline void pointKDLToMsg(const KDL::Vector& k, geometry_msgs::Point& m) {
  m.x = k.x();
  m.y = k.y();
  m.z = k.z();
}
inline void vectorMsgToKDL(const geometry_msgs::Vector3& m, KDL::Vector& k) { k = KDL::Vector(m.x, m.y, m.z); }
inline void vectorKDLToMsg(const KDL::Vector& k, geometry_msgs::Vector3& m) {
  m.x = k.x();
  m.y = k.y();
  m.z = k.z();
}
inline void quaternionMsgToKDL(const geometry_msgs::Quaternion& m, KDL::Rotation& k) {
  k = KDL::Rotation::Quaternion(m.x, m.y, m.z, m.w);
}
inline void quaternionKDLToMsg(const KDL::Rotation& k, geometry_msgs::Quaternion& m) {
  k.GetQuaternion(m.x, m.y, m.z, m.w);
}
inline void poseMsgToKDL(const geometry_msgs::Pose& m, KDL::Frame& k) {
  pointMsgToKDL(m.position, k.p);
  quaternionMsgToKDL(m.orientation, k.M);
}
inline void poseKDLToMsg(const KDL::Frame& k, geometry_msgs::Pose& m) {
  pointKDLToMsg(k.p, m.position);
  quaternionKDLToMsg(k.M, m.orientation);
}
inline void transformMsgToKDL(const geometry_msgs::Transform& m, KDL::Frame& k) {
  vectorMsgToKDL(m.translation, k.p);
  quaternionMsgToKDL(m.rotation, k.M);
}
inline void transformKDLToMsg(const KDL::Frame& k, geometry_msgs::Transform& m) {
  vectorKDLToMsg(k.p, m.translation);
  quaternionKDLToMsg(k.M, m.rotation);
}
inline void twistMsgToKDL(const geometry_msgs::Twist& m, KDL::Twist& k) {
  vectorMsgToKDL(m.linear, k.vel);
  vectorMsgToKDL(m.angular, k.rot);
}
inline void twistKDLToMsg(const KDL::Twist& k, geometry_msgs::Twist& m) {
  vectorKDLToMsg(k.vel, m.linear);
  vectorKDLToMsg(k.rot, m.angular);
}
inline void wrenchMsgToKDL(const geometry_msgs::Wrench& m, KDL::Wrench& k) {
  vectorMsgToKDL(m.force, k.force);
  vectorMsgToKDL(m.torque, k.torque);
}
inline void wrenchKDLToMsg(const KDL::Wrench& k, geometry_msgs::Wrench& m) {
  vectorKDLToMsg(k.force, m.force);
  vectorKDLToMsg(k.torque, m.torque);
}

}  // namespace tf
