#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <ros/time.h>
#include <tf2/buffer_core.h>
#include <tf2/convert.h>

#include <sstream>
#include <string>

namespace tf2_ros {

/** Lookups that may wait, and transforms of messages. */
class BufferInterface {
 public:
  virtual ~BufferInterface() {}
  virtual geometry_msgs::TransformStamped lookupTransform(const std::string& target_frame,
                                                          const std::string& source_frame, const ros::Time& time,
                                                          const ros::Duration timeout) const = 0;
  virtual geometry_msgs::TransformStamped lookupTransform(const std::string& target_frame, const ros::Time& target_time,
                                                          const std::string& source_frame, const ros::Time& source_time,
                                                          const std::string& fixed_frame,
                                                          const ros::Duration timeout) const = 0;
  virtual bool canTransform(const std::string& target_frame, const std::string& source_frame, const ros::Time& time,
                            const ros::Duration timeout, std::string* errstr = nullptr) const = 0;
  virtual bool canTransform(const std::string& target_frame, const ros::Time& target_time,
                            const std::string& source_frame, const ros::Time& source_time,
                            const std::string& fixed_frame, const ros::Duration timeout,
                            std::string* errstr = nullptr) const = 0;

  template <class T>
  T& transform(const T& in, T& out, const std::string& target_frame, ros::Duration timeout = ros::Duration(0.0)) const {
    tf2::doTransform(in, out, lookupTransform(target_frame, tf2::getFrameId(in), tf2::getTimestamp(in), timeout));
    return out;
  }
  template <class T>
  T transform(const T& in, const std::string& target_frame, ros::Duration timeout = ros::Duration(0.0)) const {
    T out;
    return transform(in, out, target_frame, timeout);
  }
  /** Transform, and convert to another type. */
  template <class A, class B>
  B& transform(const A& in, B& out, const std::string& target_frame, ros::Duration timeout = ros::Duration(0.0)) const {
    tf2::convert(transform(in, target_frame, timeout), out);
    return out;
  }
  /** The same at another time, which a fixed frame relates. */
  template <class T>
  T& transform(const T& in, T& out, const std::string& target_frame, const ros::Time& target_time,
               const std::string& fixed_frame, ros::Duration timeout = ros::Duration(0.0)) const {
    tf2::doTransform(
        in, out,
        lookupTransform(target_frame, target_time, tf2::getFrameId(in), tf2::getTimestamp(in), fixed_frame, timeout));
    return out;
  }
  template <class T>
  T transform(const T& in, const std::string& target_frame, const ros::Time& target_time,
              const std::string& fixed_frame, ros::Duration timeout = ros::Duration(0.0)) const {
    T out;
    return transform(in, out, target_frame, target_time, fixed_frame, timeout);
  }
  template <class A, class B>
  B& transform(const A& in, B& out, const std::string& target_frame, const ros::Time& target_time,
               const std::string& fixed_frame, ros::Duration timeout = ros::Duration(0.0)) const {
    tf2::convert(transform(in, target_frame, target_time, fixed_frame, timeout), out);
    return out;
  }
};

}  // namespace tf2_ros
