#include "tf/tf.h"

#include <algorithm>

#include "tf/transform_broadcaster.h"
#include "tf/transform_listener.h"

namespace tf {
namespace {

StampedTransform fromMessage(const geometry_msgs::TransformStamped& m) {
  StampedTransform t;
  transformStampedMsgToTF(m, t);
  return t;
}

}  // namespace

std::string resolve(const std::string& prefix, const std::string& frame_name) {
  if (!frame_name.empty() && frame_name[0] == '/') return frame_name.substr(1);
  const std::string stripped = !prefix.empty() && prefix[0] == '/' ? prefix.substr(1) : prefix;
  return stripped.empty() ? frame_name : stripped + "/" + frame_name;
}

void TransformBroadcaster::sendTransform(const StampedTransform& transform) {
  sendTransform(std::vector<StampedTransform>{transform});
}

void TransformBroadcaster::sendTransform(const std::vector<StampedTransform>& transforms) {
  std::vector<geometry_msgs::TransformStamped> messages(transforms.size());
  for (size_t i = 0; i < transforms.size(); ++i) transformStampedTFToMsg(transforms[i], messages[i]);
  broadcaster_.sendTransform(messages);
}

Transformer::Transformer(bool, ros::Duration cache_time) : buffer_(boost::make_shared<tf2_ros::Buffer>(cache_time)) {}

bool Transformer::setTransform(const StampedTransform& transform, const std::string& authority) {
  geometry_msgs::TransformStamped message;
  transformStampedTFToMsg(transform, message);
  return buffer_->setTransform(message, authority);
}

void Transformer::lookupTransform(const std::string& target_frame, const std::string& source_frame,
                                  const ros::Time& time, StampedTransform& transform) const {
  transform = fromMessage(buffer_->lookupTransform(target_frame, source_frame, time));
}

void Transformer::lookupTransform(const std::string& target_frame, const ros::Time& target_time,
                                  const std::string& source_frame, const ros::Time& source_time,
                                  const std::string& fixed_frame, StampedTransform& transform) const {
  transform = fromMessage(buffer_->lookupTransform(target_frame, target_time, source_frame, source_time, fixed_frame));
}

bool Transformer::waitForTransform(const std::string& target_frame, const std::string& source_frame,
                                   const ros::Time& time, const ros::Duration& timeout, const ros::Duration&,
                                   std::string* error_msg) const {
  return buffer_->canTransform(target_frame, source_frame, time, timeout, error_msg);
}

bool Transformer::canTransform(const std::string& target_frame, const std::string& source_frame, const ros::Time& time,
                               std::string* error_msg) const {
  return buffer_->canTransform(target_frame, source_frame, time, error_msg);
}

bool Transformer::waitForTransform(const std::string& target_frame, const ros::Time& target_time,
                                   const std::string& source_frame, const ros::Time& source_time,
                                   const std::string& fixed_frame, const ros::Duration& timeout, const ros::Duration&,
                                   std::string* error_msg) const {
  return buffer_->canTransform(target_frame, target_time, source_frame, source_time, fixed_frame, timeout, error_msg);
}

bool Transformer::canTransform(const std::string& target_frame, const ros::Time& target_time,
                               const std::string& source_frame, const ros::Time& source_time,
                               const std::string& fixed_frame, std::string* error_msg) const {
  return buffer_->canTransform(target_frame, target_time, source_frame, source_time, fixed_frame, error_msg);
}

void Transformer::lookupTwist(const std::string& tracking_frame, const std::string& observation_frame,
                              const ros::Time& time, const ros::Duration& averaging_interval,
                              geometry_msgs::Twist& twist) const {
  lookupTwist(tracking_frame, observation_frame, observation_frame, Point(0, 0, 0), tracking_frame, time,
              averaging_interval, twist);
}

void Transformer::lookupTwist(const std::string& tracking_frame, const std::string& observation_frame,
                              const std::string& reference_frame, const Point& reference_point,
                              const std::string& reference_point_frame, const ros::Time& time,
                              const ros::Duration& averaging_interval, geometry_msgs::Twist& twist) const {
  ros::Time latest;
  getLatestCommonTime(observation_frame, tracking_frame, latest);
  const ros::Time at = time.isZero() ? latest : time;
  const ros::Time end = std::min(at + averaging_interval * 0.5, latest);
  // Time 0 would be the latest transform.
  const ros::Time start = std::max(end, ros::Time(0.00001) + averaging_interval) - averaging_interval;
  const double period = (end - start).toSec();
  StampedTransform before, after, tracking;
  lookupTransform(observation_frame, tracking_frame, start, before);
  lookupTransform(observation_frame, tracking_frame, end, after);
  lookupTransform(reference_frame, tracking_frame, at, tracking);

  Quaternion turn;
  (before.getBasis().transpose() * after.getBasis()).getRotation(turn);
  const Vector3 velocity = (after.getOrigin() - before.getOrigin()) / period;
  const Vector3 angular = tracking.getBasis() * (before.getBasis() * turn.getAxis()) * (turn.getAngle() / period);
  Stamped<Point> point(reference_point, at, reference_point_frame);
  transformPoint(reference_frame, point, point);
  const Vector3 linear =
      tracking.getBasis() * velocity + tracking.getOrigin().cross(angular) + angular * (point - tracking.getOrigin());
  vector3TFToMsg(linear, twist.linear);
  vector3TFToMsg(angular, twist.angular);
}

int Transformer::getLatestCommonTime(const std::string& source_frame, const std::string& target_frame, ros::Time& time,
                                     std::string* error_string) const {
  try {
    time = buffer_->getLatestCommonTime(target_frame, source_frame);
    return 0;
  } catch (const tf2::LookupException& error) {
    if (error_string) *error_string = error.what();
    return 1;
  } catch (const tf2::TransformException& error) {
    if (error_string) *error_string = error.what();
    return 2;
  }
}

void Transformer::transformQuaternion(const std::string& target_frame, const Stamped<Quaternion>& in,
                                      Stamped<Quaternion>& out) const {
  StampedTransform transform;
  lookupTransform(target_frame, in.frame_id_, in.stamp_, transform);
  out = Stamped<Quaternion>(transform * static_cast<const Quaternion&>(in), transform.stamp_, target_frame);
}

void Transformer::transformVector(const std::string& target_frame, const Stamped<Vector3>& in,
                                  Stamped<Vector3>& out) const {
  StampedTransform transform;
  lookupTransform(target_frame, in.frame_id_, in.stamp_, transform);
  out = Stamped<Vector3>(transform.getBasis() * in, transform.stamp_, target_frame);
}

void Transformer::transformPoint(const std::string& target_frame, const Stamped<Point>& in, Stamped<Point>& out,
                                 int) const {
  StampedTransform transform;
  lookupTransform(target_frame, in.frame_id_, in.stamp_, transform);
  out = Stamped<Point>(transform * static_cast<const Point&>(in), transform.stamp_, target_frame);
}

void Transformer::transformPose(const std::string& target_frame, const Stamped<Pose>& in, Stamped<Pose>& out) const {
  StampedTransform transform;
  lookupTransform(target_frame, in.frame_id_, in.stamp_, transform);
  out = Stamped<Pose>(transform * static_cast<const Pose&>(in), transform.stamp_, target_frame);
}

void Transformer::transformQuaternion(const std::string& target_frame, const ros::Time& target_time,
                                      const Stamped<Quaternion>& in, const std::string& fixed_frame,
                                      Stamped<Quaternion>& out) const {
  StampedTransform transform;
  lookupTransform(target_frame, target_time, in.frame_id_, in.stamp_, fixed_frame, transform);
  out = Stamped<Quaternion>(transform * static_cast<const Quaternion&>(in), transform.stamp_, target_frame);
}

void Transformer::transformVector(const std::string& target_frame, const ros::Time& target_time,
                                  const Stamped<Vector3>& in, const std::string& fixed_frame,
                                  Stamped<Vector3>& out) const {
  StampedTransform transform;
  lookupTransform(target_frame, target_time, in.frame_id_, in.stamp_, fixed_frame, transform);
  out = Stamped<Vector3>(transform.getBasis() * in, transform.stamp_, target_frame);
}

void Transformer::transformPoint(const std::string& target_frame, const ros::Time& target_time,
                                 const Stamped<Point>& in, const std::string& fixed_frame, Stamped<Point>& out) const {
  StampedTransform transform;
  lookupTransform(target_frame, target_time, in.frame_id_, in.stamp_, fixed_frame, transform);
  out = Stamped<Point>(transform * static_cast<const Point&>(in), transform.stamp_, target_frame);
}

void Transformer::transformPose(const std::string& target_frame, const ros::Time& target_time, const Stamped<Pose>& in,
                                const std::string& fixed_frame, Stamped<Pose>& out) const {
  StampedTransform transform;
  lookupTransform(target_frame, target_time, in.frame_id_, in.stamp_, fixed_frame, transform);
  out = Stamped<Pose>(transform * static_cast<const Pose&>(in), transform.stamp_, target_frame);
}

TransformListener::TransformListener(ros::Duration max_cache_time, bool spin_thread)
    : Transformer(true, max_cache_time), listener_(*buffer_, spin_thread) {
  readPrefix();
}

TransformListener::TransformListener(const ros::NodeHandle& nh, ros::Duration max_cache_time, bool spin_thread)
    : Transformer(true, max_cache_time), listener_(*buffer_, nh, spin_thread) {
  readPrefix();
}

void TransformListener::readPrefix() {
  std::string key;
  if (ros::NodeHandle("~").searchParam("tf_prefix", key)) ros::param::get(key, prefix_);
}

// Transform a message into another frame, and to another time, through its tf class.
#define TF_TRANSFORM(Name, Message, name, Value)                                                             \
  void TransformListener::transform##Name(const std::string& target_frame, const geometry_msgs::Message& in, \
                                          geometry_msgs::Message& out) const {                               \
    Stamped<Value> value, result;                                                                            \
    name##StampedMsgToTF(in, value);                                                                         \
    Transformer::transform##Name(target_frame, value, result);                                               \
    name##StampedTFToMsg(result, out);                                                                       \
  }                                                                                                          \
  void TransformListener::transform##Name(const std::string& target_frame, const ros::Time& target_time,     \
                                          const geometry_msgs::Message& in, const std::string& fixed_frame,  \
                                          geometry_msgs::Message& out) const {                               \
    Stamped<Value> value, result;                                                                            \
    name##StampedMsgToTF(in, value);                                                                         \
    Transformer::transform##Name(target_frame, target_time, value, fixed_frame, result);                     \
    name##StampedTFToMsg(result, out);                                                                       \
  }
TF_TRANSFORM(Quaternion, QuaternionStamped, quaternion, Quaternion)
TF_TRANSFORM(Vector, Vector3Stamped, vector3, Vector3)
TF_TRANSFORM(Point, PointStamped, point, Point)
TF_TRANSFORM(Pose, PoseStamped, pose, Pose)
#undef TF_TRANSFORM

namespace {

void movePoints(const Transform& transform, const std::string& frame, const ros::Time& time,
                const sensor_msgs::PointCloud& in, sensor_msgs::PointCloud& out) {
  if (&in != &out) out = in;
  out.header.frame_id = frame;
  out.header.stamp = time;
  for (geometry_msgs::Point32& point : out.points) {
    const Vector3 moved = transform * Vector3(point.x, point.y, point.z);
    point.x = static_cast<float>(moved.x());
    point.y = static_cast<float>(moved.y());
    point.z = static_cast<float>(moved.z());
  }
}

}  // namespace

void TransformListener::transformPointCloud(const std::string& target_frame, const sensor_msgs::PointCloud& in,
                                            sensor_msgs::PointCloud& out) const {
  StampedTransform transform;
  lookupTransform(target_frame, in.header.frame_id, in.header.stamp, transform);
  movePoints(transform, target_frame, in.header.stamp, in, out);
}

void TransformListener::transformPointCloud(const std::string& target_frame, const ros::Time& target_time,
                                            const sensor_msgs::PointCloud& in, const std::string& fixed_frame,
                                            sensor_msgs::PointCloud& out) const {
  StampedTransform transform;
  lookupTransform(target_frame, target_time, in.header.frame_id, in.header.stamp, fixed_frame, transform);
  movePoints(transform, target_frame, target_time, in, out);
}

}  // namespace tf
