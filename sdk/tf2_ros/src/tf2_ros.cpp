#include <tf2_msgs/TFMessage.h>

#include "tf2_ros/buffer.h"
#include "tf2_ros/static_transform_broadcaster.h"
#include "tf2_ros/transform_broadcaster.h"
#include "tf2_ros/transform_listener.h"

namespace tf2_ros {
namespace {

/** Poll a condition until it is true; false after a timeout of ROS time, if the node shuts down, or without a thread
that could make it true. */
template <class Condition>
bool waitFor(const tf2::BufferCore& buffer, const ros::Duration& timeout, std::string* error,
             const Condition& condition) {
  if (!buffer.isUsingDedicatedThread()) {
    ROS_ERROR("%s", threading_error.c_str());
    if (error) *error = threading_error;
    return false;
  }
  const ros::Time end = ros::Time::now() + timeout;
  while (!condition()) {
    if (!ros::ok() || ros::Time::now() >= end) return false;
    ros::WallDuration(0.005).sleep();
  }
  return true;
}

}  // namespace

TransformBroadcaster::TransformBroadcaster() : publisher_(node_.advertise<tf2_msgs::TFMessage>("/tf", 100)) {}

void TransformBroadcaster::sendTransform(const geometry_msgs::TransformStamped& transform) {
  sendTransform(std::vector<geometry_msgs::TransformStamped>{transform});
}

void TransformBroadcaster::sendTransform(const std::vector<geometry_msgs::TransformStamped>& transforms) {
  tf2_msgs::TFMessage message;
  message.transforms = transforms;
  publisher_.publish(message);
}

StaticTransformBroadcaster::StaticTransformBroadcaster()
    : publisher_(node_.advertise<tf2_msgs::TFMessage>("/tf_static", 100, true)) {}

void StaticTransformBroadcaster::sendTransform(const geometry_msgs::TransformStamped& transform) {
  sendTransform(std::vector<geometry_msgs::TransformStamped>{transform});
}

void StaticTransformBroadcaster::sendTransform(const std::vector<geometry_msgs::TransformStamped>& transforms) {
  // The topic is latched: later subscribers get only the last message, so each message holds all transforms.
  for (const geometry_msgs::TransformStamped& transform : transforms) sent_[transform.child_frame_id] = transform;
  tf2_msgs::TFMessage message;
  for (const auto& entry : sent_) message.transforms.push_back(entry.second);
  publisher_.publish(message);
}

geometry_msgs::TransformStamped Buffer::lookupTransform(const std::string& target_frame,
                                                        const std::string& source_frame, const ros::Time& time,
                                                        const ros::Duration timeout) const {
  canTransform(target_frame, source_frame, time, timeout);
  return lookupTransform(target_frame, source_frame, time);
}

geometry_msgs::TransformStamped Buffer::lookupTransform(const std::string& target_frame, const ros::Time& target_time,
                                                        const std::string& source_frame, const ros::Time& source_time,
                                                        const std::string& fixed_frame,
                                                        const ros::Duration timeout) const {
  canTransform(target_frame, target_time, source_frame, source_time, fixed_frame, timeout);
  return lookupTransform(target_frame, target_time, source_frame, source_time, fixed_frame);
}

bool Buffer::canTransform(const std::string& target_frame, const std::string& source_frame, const ros::Time& time,
                          const ros::Duration timeout, std::string* errstr) const {
  return waitFor(*this, timeout, errstr,
                 [&] { return BufferCore::canTransform(target_frame, source_frame, time, errstr); });
}

bool Buffer::canTransform(const std::string& target_frame, const ros::Time& target_time,
                          const std::string& source_frame, const ros::Time& source_time, const std::string& fixed_frame,
                          const ros::Duration timeout, std::string* errstr) const {
  return waitFor(*this, timeout, errstr, [&] {
    return BufferCore::canTransform(target_frame, target_time, source_frame, source_time, fixed_frame, errstr);
  });
}

TransformListener::TransformListener(tf2::BufferCore& buffer, bool spin_thread, ros::TransportHints hints)
    : buffer_(buffer) {
  subscribe(spin_thread, hints);
}

TransformListener::TransformListener(tf2::BufferCore& buffer, const ros::NodeHandle& node, bool spin_thread,
                                     ros::TransportHints hints)
    : buffer_(buffer), node_(node) {
  subscribe(spin_thread, hints);
}

TransformListener::~TransformListener() {
  if (spinner_) spinner_->stop();
  moving_.shutdown();
  fixed_.shutdown();
}

void TransformListener::subscribe(bool spin_thread, const ros::TransportHints& hints) {
  if (spin_thread) node_.setCallbackQueue(&queue_);
  typedef const ros::MessageEvent<tf2_msgs::TFMessage const>& Event;
  moving_ = node_.subscribe<tf2_msgs::TFMessage, Event>(
      "/tf", 100, [this](Event event) { receive(event, false); }, ros::VoidConstPtr(), hints);
  fixed_ =
      node_.subscribe<tf2_msgs::TFMessage, Event>("/tf_static", 100, [this](Event event) { receive(event, true); });
  if (!spin_thread) return;
  spinner_.reset(new ros::AsyncSpinner(1, &queue_));
  spinner_->start();
  buffer_.setUsingDedicatedThread(true);
}

void TransformListener::receive(const ros::MessageEvent<tf2_msgs::TFMessage const>& event, bool is_static) {
  const ros::Time now = ros::Time::now();
  if (now < last_) {
    ROS_WARN("Detected jump back in time of %fs. Clearing TF buffer.", (last_ - now).toSec());
    buffer_.clear();
  }
  last_ = now;
  for (const geometry_msgs::TransformStamped& transform : event.getConstMessage()->transforms)
    buffer_.setTransform(transform, event.getPublisherName(), is_static);
}

}  // namespace tf2_ros
