#pragma once

#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/QuaternionStamped.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/Vector3Stamped.h>
#include <ros/console.h>
#include <ros/time.h>

#include <string>

#include "tf/LinearMath/Matrix3x3.h"
#include "tf/LinearMath/Quaternion.h"
#include "tf/LinearMath/Scalar.h"
#include "tf/LinearMath/Transform.h"
#include "tf/LinearMath/Vector3.h"
#include "tf/exceptions.h"

namespace tf {

typedef tf::Vector3 Point;
typedef tf::Transform Pose;

/** Value with a time and a frame. */
template <typename T>
class Stamped : public T {
 public:
  ros::Time stamp_;
  std::string frame_id_;

  Stamped() : frame_id_("NO_ID_STAMPED_DEFAULT_CONSTRUCTION") {}
  Stamped(const T& input, const ros::Time& timestamp, const std::string& frame_id)
      : T(input), stamp_(timestamp), frame_id_(frame_id) {}
  void setData(const T& input) { *static_cast<T*>(this) = input; }
};
template <class T>
bool operator==(const Stamped<T>& a, const Stamped<T>& b) {
  return a.frame_id_ == b.frame_id_ && a.stamp_ == b.stamp_ && static_cast<const T&>(a) == static_cast<const T&>(b);
}

/** Transform from a child frame to its parent. */
class StampedTransform : public tf::Transform {
 public:
  ros::Time stamp_;
  std::string frame_id_, child_frame_id_;

  StampedTransform() {}
  StampedTransform(const tf::Transform& input, const ros::Time& timestamp, const std::string& frame_id,
                   const std::string& child_frame_id)
      : tf::Transform(input), stamp_(timestamp), frame_id_(frame_id), child_frame_id_(child_frame_id) {}
  void setData(const tf::Transform& input) { *static_cast<tf::Transform*>(this) = input; }
};
inline bool operator==(const StampedTransform& a, const StampedTransform& b) {
  return a.frame_id_ == b.frame_id_ && a.child_frame_id_ == b.child_frame_id_ && a.stamp_ == b.stamp_ &&
         static_cast<const tf::Transform&>(a) == static_cast<const tf::Transform&>(b);
}

inline Quaternion createIdentityQuaternion() { return Quaternion::getIdentity(); }
inline Quaternion createQuaternionFromRPY(double roll, double pitch, double yaw) {
  Quaternion q;
  q.setRPY(roll, pitch, yaw);
  return q;
}
inline Quaternion createQuaternionFromYaw(double yaw) { return createQuaternionFromRPY(0.0, 0.0, yaw); }

inline void quaternionMsgToTF(const geometry_msgs::Quaternion& m, Quaternion& q) {
  q = Quaternion(m.x, m.y, m.z, m.w);
  if (std::fabs(q.length2() - 1.0) > 0.1) {
    ROS_WARN("MSG to TF: Quaternion Not Properly Normalized");
    q.normalize();
  }
}
inline void quaternionTFToMsg(const Quaternion& given, geometry_msgs::Quaternion& m) {
  const Quaternion q = given.normalized();
  m.x = q.x();
  m.y = q.y();
  m.z = q.z();
  m.w = q.w();
}
inline geometry_msgs::Quaternion createQuaternionMsgFromRollPitchYaw(double roll, double pitch, double yaw) {
  geometry_msgs::Quaternion m;
  quaternionTFToMsg(createQuaternionFromRPY(roll, pitch, yaw), m);
  return m;
}
inline geometry_msgs::Quaternion createQuaternionMsgFromYaw(double yaw) {
  return createQuaternionMsgFromRollPitchYaw(0.0, 0.0, yaw);
}
inline double getYaw(const Quaternion& q) {
  double yaw, pitch, roll;
  Matrix3x3(q).getEulerYPR(yaw, pitch, roll);
  return yaw;
}
inline double getYaw(const geometry_msgs::Quaternion& m) {
  Quaternion q;
  quaternionMsgToTF(m, q);
  return getYaw(q);
}

inline void vector3MsgToTF(const geometry_msgs::Vector3& m, Vector3& v) { v = Vector3(m.x, m.y, m.z); }
inline void vector3TFToMsg(const Vector3& v, geometry_msgs::Vector3& m) {
  m.x = v.x();
  m.y = v.y();
  m.z = v.z();
}
inline void pointMsgToTF(const geometry_msgs::Point& m, Point& v) { v = Vector3(m.x, m.y, m.z); }
inline void pointTFToMsg(const Point& v, geometry_msgs::Point& m) {
  m.x = v.x();
  m.y = v.y();
  m.z = v.z();
}
inline void transformMsgToTF(const geometry_msgs::Transform& m, Transform& t) {
  t = Transform(Quaternion(m.rotation.x, m.rotation.y, m.rotation.z, m.rotation.w),
                Vector3(m.translation.x, m.translation.y, m.translation.z));
}
inline void transformTFToMsg(const Transform& t, geometry_msgs::Transform& m) {
  vector3TFToMsg(t.getOrigin(), m.translation);
  quaternionTFToMsg(t.getRotation(), m.rotation);
}
inline void poseMsgToTF(const geometry_msgs::Pose& m, Pose& t) {
  t = Transform(Quaternion(m.orientation.x, m.orientation.y, m.orientation.z, m.orientation.w),
                Vector3(m.position.x, m.position.y, m.position.z));
}
inline void poseTFToMsg(const Pose& t, geometry_msgs::Pose& m) {
  pointTFToMsg(t.getOrigin(), m.position);
  quaternionTFToMsg(t.getRotation(), m.orientation);
}

#define TF_STAMPED(name, Message, field, Value)                                          \
  inline void name##StampedMsgToTF(const geometry_msgs::Message& m, Stamped<Value>& v) { \
    name##MsgToTF(m.field, v);                                                           \
    v.stamp_ = m.header.stamp;                                                           \
    v.frame_id_ = m.header.frame_id;                                                     \
  }                                                                                      \
  inline void name##StampedTFToMsg(const Stamped<Value>& v, geometry_msgs::Message& m) { \
    name##TFToMsg(v, m.field);                                                           \
    m.header.stamp = v.stamp_;                                                           \
    m.header.frame_id = v.frame_id_;                                                     \
  }
TF_STAMPED(quaternion, QuaternionStamped, quaternion, Quaternion)
TF_STAMPED(vector3, Vector3Stamped, vector, Vector3)
TF_STAMPED(point, PointStamped, point, Point)
TF_STAMPED(pose, PoseStamped, pose, Pose)
#undef TF_STAMPED

inline void transformStampedMsgToTF(const geometry_msgs::TransformStamped& m, StampedTransform& t) {
  transformMsgToTF(m.transform, t);
  t.stamp_ = m.header.stamp;
  t.frame_id_ = m.header.frame_id;
  t.child_frame_id_ = m.child_frame_id;
}
inline void transformStampedTFToMsg(const StampedTransform& t, geometry_msgs::TransformStamped& m) {
  transformTFToMsg(t, m.transform);
  m.header.stamp = t.stamp_;
  m.header.frame_id = t.frame_id_;
  m.child_frame_id = t.child_frame_id_;
}

}  // namespace tf
