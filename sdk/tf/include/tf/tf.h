#pragma once

#include <geometry_msgs/TwistStamped.h>
#include <tf2_ros/buffer.h>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <list>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tf/exceptions.h"
#include "tf/transform_datatypes.h"

namespace tf {

/** Name of a frame with the prefix; a name with a leading slash gets no prefix. */
std::string resolve(const std::string& prefix, const std::string& frame_name);

/** Throw InvalidArgument unless a quaternion has length 1: its square may be wrong by a hundredth, as in tf. */
inline void assertQuaternionValid(const Quaternion& q) {
  if (!(std::fabs(q.length2() - 1) <= 0.01)) {  // also for NaN
    std::ostringstream text;
    text << "the quaternion " << q.x() << " " << q.y() << " " << q.z() << " " << q.w() << " has length " << q.length()
         << ", not 1";
    throw InvalidArgument(text.str());
  }
}
inline void assertQuaternionValid(const geometry_msgs::Quaternion& q) {
  assertQuaternionValid(Quaternion(q.x, q.y, q.z, q.w));
}

/** Transforms of the last seconds; time 0 is the latest time. */
class Transformer {
 public:
  explicit Transformer(bool interpolating = true, ros::Duration cache_time = ros::Duration(10.0));
  virtual ~Transformer() {}

  void clear() { buffer_->clear(); }
  void setUsingDedicatedThread(bool is_used) { buffer_->setUsingDedicatedThread(is_used); }
  bool isUsingDedicatedThread() const { return buffer_->isUsingDedicatedThread(); }
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
  bool canTransform(const std::string& target_frame, const ros::Time& target_time, const std::string& source_frame,
                    const ros::Time& source_time, const std::string& fixed_frame,
                    std::string* error_msg = nullptr) const;
  bool waitForTransform(const std::string& target_frame, const ros::Time& target_time, const std::string& source_frame,
                        const ros::Time& source_time, const std::string& fixed_frame, const ros::Duration& timeout,
                        const ros::Duration& polling_sleep_duration = ros::Duration(0.01),
                        std::string* error_msg = nullptr) const;
  /** Mean twist of a frame, as seen from another, in an interval around a time; near the latest time, before it.

  The values are tf's, whose formulas hold for `tracking_frame` not rotated in `observation_frame`: velocities are
  rotated by the tracking frame's rotation in `reference_frame`, and the shift to another reference point multiplies
  vectors by component. */
  void lookupTwist(const std::string& tracking_frame, const std::string& observation_frame,
                   const std::string& reference_frame, const Point& reference_point,
                   const std::string& reference_point_frame, const ros::Time& time,
                   const ros::Duration& averaging_interval, geometry_msgs::Twist& twist) const;
  /** The same at the origin of the tracking frame, in the observation frame. */
  void lookupTwist(const std::string& tracking_frame, const std::string& observation_frame, const ros::Time& time,
                   const ros::Duration& averaging_interval, geometry_msgs::Twist& twist) const;
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

  /** Transform from the time of `in` to another time; the fixed frame is where both are related. */
  void transformQuaternion(const std::string& target_frame, const ros::Time& target_time, const Stamped<Quaternion>& in,
                           const std::string& fixed_frame, Stamped<Quaternion>& out) const;
  void transformVector(const std::string& target_frame, const ros::Time& target_time, const Stamped<Vector3>& in,
                       const std::string& fixed_frame, Stamped<Vector3>& out) const;
  void transformPoint(const std::string& target_frame, const ros::Time& target_time, const Stamped<Point>& in,
                      const std::string& fixed_frame, Stamped<Point>& out) const;
  void transformPose(const std::string& target_frame, const ros::Time& target_time, const Stamped<Pose>& in,
                     const std::string& fixed_frame, Stamped<Pose>& out) const;

 protected:
  boost::shared_ptr<tf2_ros::Buffer> buffer_;
};

}  // namespace tf
