#pragma once

#include <geometry_msgs/TransformStamped.h>
#include <ros/duration.h>
#include <ros/time.h>

#include <atomic>
#include <boost/function.hpp>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "tf2/LinearMath/Quaternion.h"
#include "tf2/LinearMath/Transform.h"
#include "tf2/exceptions.h"
#include "tf2/transform_datatypes.h"

namespace tf2 {

/** Tree of frames over the last seconds; thread-safe. */
typedef uint32_t TransformableCallbackHandle;
/** Number of a request; 0: it is transformable already; all bits: it never will be. */
typedef uint64_t TransformableRequestHandle;
enum TransformableResult { TransformAvailable, TransformFailure };

class BufferCore {
 public:
  static const int DEFAULT_CACHE_TIME = 10;

  explicit BufferCore(ros::Duration cache_time = ros::Duration(DEFAULT_CACHE_TIME)) : cache_time_(cache_time) {}
  virtual ~BufferCore() {}

  void clear();
  /** Add a transform; false if it is invalid or too old. */
  bool setTransform(const geometry_msgs::TransformStamped& transform, const std::string& authority,
                    bool is_static = false);
  /** Transform of coordinates in the source frame to the target frame; time 0 is the latest common time. */
  geometry_msgs::TransformStamped lookupTransform(const std::string& target_frame, const std::string& source_frame,
                                                  const ros::Time& time) const;
  /** As above, between two times, which a fixed frame relates. */
  geometry_msgs::TransformStamped lookupTransform(const std::string& target_frame, const ros::Time& target_time,
                                                  const std::string& source_frame, const ros::Time& source_time,
                                                  const std::string& fixed_frame) const;
  bool canTransform(const std::string& target_frame, const std::string& source_frame, const ros::Time& time,
                    std::string* error_msg = nullptr) const;
  bool canTransform(const std::string& target_frame, const ros::Time& target_time, const std::string& source_frame,
                    const ros::Time& source_time, const std::string& fixed_frame,
                    std::string* error_msg = nullptr) const;
  ros::Duration getCacheLength() const { return cache_time_; }
  void getFrameStrings(std::vector<std::string>& frames) const;
  bool frameExists(const std::string& frame) const;
  /** Parent of a frame at a time; false if there is none. */
  bool getParent(const std::string& frame, ros::Time time, std::string& parent) const;
  ros::Time getLatestCommonTime(const std::string& target_frame, const std::string& source_frame) const;
  std::string allFramesAsString() const;
  std::string allFramesAsYAML() const;
  /** Call a function after each transform that is set, in that thread, until the number that is returned is removed. */
  size_t addTransformsListener(const boost::function<void()>& listener);
  void removeTransformsListener(size_t number);
  typedef boost::function<void(TransformableRequestHandle request, const std::string& target_frame,
                               const std::string& source_frame, ros::Time time, TransformableResult result)>
      TransformableCallback;
  /** A function for requests, called by setTransform(). */
  TransformableCallbackHandle addTransformableCallback(const TransformableCallback& callback);
  /** Forget a function, and the requests that wait for it. */
  void removeTransformableCallback(TransformableCallbackHandle handle);
  /** Call a function once when frames are transformable at a time, or when that time has left the cache. */
  TransformableRequestHandle addTransformableRequest(TransformableCallbackHandle handle,
                                                     const std::string& target_frame, const std::string& source_frame,
                                                     ros::Time time);
  void cancelTransformableRequest(TransformableRequestHandle handle);
  /** Announce that another thread sets transforms, so that this one may wait for them. */
  void setUsingDedicatedThread(bool is_used) { has_thread_ = is_used; }
  bool isUsingDedicatedThread() const { return has_thread_; }

 private:
  struct Sample {
    ros::Time stamp;
    std::string parent;
    Vector3 origin;
    Quaternion rotation;
  };
  struct Frame {
    bool is_static = false;
    std::string authority;
    std::map<ros::Time, Sample> samples;
  };
  /** Rotation and translation; the signs of products of quaternions are those of the original. */
  struct Motion {
    Quaternion rotation;
    Vector3 origin;
    static Motion identity() { return {Quaternion::getIdentity(), Vector3(0.0, 0.0, 0.0)}; }
    Motion operator*(const Motion& other) const {
      return {rotation * other.rotation, quatRotate(rotation, other.origin) + origin};
    }
    Motion inverse() const { return {rotation.inverse(), quatRotate(rotation.inverse(), -origin)}; }
  };
  static geometry_msgs::TransformStamped message(const Motion& motion, const ros::Time& time, const std::string& target,
                                                 const std::string& source);
  /** Chain from a frame up to the root: each frame, and the motion to it from the first one. */
  struct Chain {
    std::vector<std::pair<std::string, Motion> > frames;
    std::string fault;
  };
  struct Request {
    TransformableCallbackHandle callback;
    std::string target, source;
    ros::Time time;
  };
  bool hasLeft(const Request& request) const;
  void answerRequests();
  bool store(const std::string& child, const Sample& sample, const std::string& authority, bool is_static);
  bool find(const Frame& frame, const std::string& name, const ros::Time& time, Sample& sample,
            std::string& fault) const;
  Chain chainUp(const std::string& from, const ros::Time& time, const std::string& until) const;
  Motion lookUp(const std::string& target, const std::string& source, ros::Time& time) const;
  ros::Time latestCommon(const std::string& target, const std::string& source) const;
  std::string checked(const std::string& frame, const char* what) const;
  std::vector<std::string> ancestors(const std::string& frame) const;

  mutable std::recursive_mutex mutex_;
  ros::Duration cache_time_;
  std::map<std::string, Frame> frames_;
  std::map<std::string, size_t> names_;  // frame → its place in the order in which frames came
  std::recursive_mutex listeners_mutex_;
  std::map<size_t, boost::function<void()> > listeners_;
  size_t next_listener_ = 1;
  std::map<TransformableCallbackHandle, TransformableCallback> callbacks_;
  std::map<TransformableRequestHandle, Request> requests_;
  TransformableCallbackHandle next_callback_ = 1;
  TransformableRequestHandle next_request_ = 1;
  std::atomic<bool> has_thread_{false};
};

}  // namespace tf2
