#include "tf2/buffer_core.h"

#include <ros/console.h>

#include <algorithm>
#include <sstream>

namespace tf2 {
namespace {

constexpr int kMaxDepth = 1000;  // limit of ancestors, which ends a loop of frames

std::string stripped(const std::string& frame) { return !frame.empty() && frame[0] == '/' ? frame.substr(1) : frame; }

template <class T>
std::string text(const T& value) {
  std::stringstream stream;
  stream << value;
  return stream.str();
}

bool isFinite(const geometry_msgs::Transform& t) {
  return std::isfinite(t.translation.x) && std::isfinite(t.translation.y) && std::isfinite(t.translation.z) &&
         std::isfinite(t.rotation.x) && std::isfinite(t.rotation.y) && std::isfinite(t.rotation.z) &&
         std::isfinite(t.rotation.w);
}

}  // namespace

geometry_msgs::TransformStamped BufferCore::message(const Motion& motion, const ros::Time& time,
                                                    const std::string& target, const std::string& source) {
  geometry_msgs::TransformStamped m;
  m.header.stamp = time;
  m.header.frame_id = target;
  m.child_frame_id = source;
  m.transform.translation.x = motion.origin.x();
  m.transform.translation.y = motion.origin.y();
  m.transform.translation.z = motion.origin.z();
  m.transform.rotation.x = motion.rotation.x();
  m.transform.rotation.y = motion.rotation.y();
  m.transform.rotation.z = motion.rotation.z();
  m.transform.rotation.w = motion.rotation.w();
  return m;
}

void BufferCore::clear() {
  const std::lock_guard<std::recursive_mutex> lock(mutex_);
  for (auto& entry : frames_)
    if (!entry.second.is_static) entry.second.samples.clear();
}

bool BufferCore::setTransform(const geometry_msgs::TransformStamped& transform, const std::string& authority,
                              bool is_static) {
  const std::string child = stripped(transform.child_frame_id), parent = stripped(transform.header.frame_id);
  const geometry_msgs::Transform& t = transform.transform;
  const Quaternion q(t.rotation.x, t.rotation.y, t.rotation.z, t.rotation.w);
  std::string fault;
  if (child.empty()) fault = "because child_frame_id not set";
  else if (parent.empty()) fault = "with child_frame_id \"" + child + "\" because frame_id not set";
  else if (child == parent) fault = "with frame_id and child_frame_id \"" + child + "\" because they are the same";
  else if (!isFinite(t)) fault = "for child_frame_id \"" + child + "\" because of a nan value in the transform";
  else if (std::fabs(q.length2() - 1.0) > 1e-2)
    fault = "for child_frame_id \"" + child + "\" because of an invalid quaternion in the transform";
  if (!fault.empty()) {
    ROS_ERROR("TF: Ignoring transform from authority \"%s\" %s", authority.c_str(), fault.c_str());
    return false;
  }
  if (!store(
          child,
          {transform.header.stamp, parent, Vector3(t.translation.x, t.translation.y, t.translation.z), q.normalized()},
          authority, is_static))
    return false;
  const std::lock_guard<std::recursive_mutex> lock(listeners_mutex_);
  const std::map<size_t, boost::function<void()> > listeners = listeners_;
  for (const auto& entry : listeners) entry.second();
  answerRequests();
  return true;
}

bool BufferCore::store(const std::string& child, const Sample& sample, const std::string& authority, bool is_static) {
  const std::lock_guard<std::recursive_mutex> lock(mutex_);
  for (const std::string& name : {child, sample.parent}) names_.emplace(name, names_.size());
  Frame& frame = frames_[child];
  if (is_static || frame.is_static) frame.samples.clear();
  frame.is_static = is_static;
  frame.authority = authority;
  const ros::Time& stamp = sample.stamp;
  if (!frame.samples.empty()) {
    const ros::Time latest = frame.samples.rbegin()->first;
    if (latest > stamp && latest - stamp > cache_time_) {
      ROS_WARN_THROTTLE(10, "TF_OLD_DATA ignoring data from the past for frame %s at time %s from authority %s",
                        child.c_str(), text(stamp).c_str(), authority.c_str());
      return false;
    }
  }
  frame.samples[stamp] = sample;
  const ros::Time latest = frame.samples.rbegin()->first;
  while (latest - frame.samples.begin()->first > cache_time_) frame.samples.erase(frame.samples.begin());
  return true;
}

TransformableCallbackHandle BufferCore::addTransformableCallback(const TransformableCallback& callback) {
  const std::lock_guard<std::recursive_mutex> lock(listeners_mutex_);
  callbacks_[next_callback_] = callback;
  return next_callback_++;
}

void BufferCore::removeTransformableCallback(TransformableCallbackHandle handle) {
  const std::lock_guard<std::recursive_mutex> lock(listeners_mutex_);
  callbacks_.erase(handle);
  for (auto at = requests_.begin(); at != requests_.end();)
    at = at->second.callback == handle ? requests_.erase(at) : std::next(at);
}

TransformableRequestHandle BufferCore::addTransformableRequest(TransformableCallbackHandle handle,
                                                               const std::string& target_frame,
                                                               const std::string& source_frame, ros::Time time) {
  const std::lock_guard<std::recursive_mutex> lock(listeners_mutex_);
  const Request request{handle, target_frame, source_frame, time};
  if (canTransform(target_frame, source_frame, time)) return 0;
  if (hasLeft(request)) return ~TransformableRequestHandle(0);
  requests_[next_request_] = request;
  return next_request_++;
}

void BufferCore::cancelTransformableRequest(TransformableRequestHandle handle) {
  const std::lock_guard<std::recursive_mutex> lock(listeners_mutex_);
  requests_.erase(handle);
}

bool BufferCore::hasLeft(const Request& request) const {
  if (request.time.isZero() || !frameExists(request.target) || !frameExists(request.source)) return false;
  const ros::Time latest = getLatestCommonTime(request.target, request.source);
  return !latest.isZero() && request.time + cache_time_ < latest;
}

void BufferCore::answerRequests() {
  const std::map<TransformableRequestHandle, Request> waiting = requests_;
  for (const auto& entry : waiting) {
    const Request& request = entry.second;
    const bool is_there = canTransform(request.target, request.source, request.time);
    if ((!is_there && !hasLeft(request)) || requests_.erase(entry.first) == 0) continue;
    const TransformableCallback callback = callbacks_[request.callback];
    if (callback)
      callback(entry.first, request.target, request.source, request.time,
               is_there ? TransformAvailable : TransformFailure);
  }
}

size_t BufferCore::addTransformsListener(const boost::function<void()>& listener) {
  const std::lock_guard<std::recursive_mutex> lock(listeners_mutex_);
  listeners_[next_listener_] = listener;
  return next_listener_++;
}

void BufferCore::removeTransformsListener(size_t number) {
  const std::lock_guard<std::recursive_mutex> lock(listeners_mutex_);
  listeners_.erase(number);
}

bool BufferCore::find(const Frame& frame, const std::string& name, const ros::Time& time, Sample& sample,
                      std::string& fault) const {
  if (frame.samples.empty()) {
    fault = "frame " + name + " has no transforms";
    return false;
  }
  if (frame.is_static || time.isZero()) {
    sample = frame.samples.rbegin()->second;
    return true;
  }
  const auto after = frame.samples.lower_bound(time);
  if (after != frame.samples.end() && after->first == time) {
    sample = after->second;
    return true;
  }
  if (after == frame.samples.begin() || after == frame.samples.end()) {
    const bool is_past = after == frame.samples.begin();
    const ros::Time edge = is_past ? after->first : frame.samples.rbegin()->first;
    fault = std::string("Lookup would require extrapolation ") + (is_past ? "into the past" : "into the future") +
            ".  Requested time " + text(time) + " but the " + (is_past ? "earliest" : "latest") + " data is at time " +
            text(edge) + ", when looking up transform of frame [" + name + "]";
    return false;
  }
  const Sample &a = std::prev(after)->second, &b = after->second;
  sample = a;
  if (a.parent != b.parent) return true;  // the frame was moved to another parent
  const double ratio = (time - a.stamp).toSec() / (b.stamp - a.stamp).toSec();
  sample.origin = a.origin.lerp(b.origin, ratio);
  sample.rotation = a.rotation.slerp(b.rotation, ratio);
  return true;
}

BufferCore::Chain BufferCore::chainUp(const std::string& from, const ros::Time& time, const std::string& until) const {
  Chain chain;
  std::string name = from;
  Motion motion = Motion::identity();
  chain.frames.emplace_back(name, motion);
  for (int depth = 0; depth < kMaxDepth && name != until; ++depth) {
    const auto frame = frames_.find(name);
    Sample sample;
    if (frame == frames_.end() || !find(frame->second, name, time, sample, chain.fault)) break;
    motion = Motion{sample.rotation, sample.origin} * motion;
    name = sample.parent;
    chain.frames.emplace_back(name, motion);
  }
  return chain;
}

std::vector<std::string> BufferCore::ancestors(const std::string& frame) const {
  std::vector<std::string> names;
  for (const auto& entry : chainUp(frame, ros::Time(), "").frames) names.push_back(entry.first);
  return names;
}

ros::Time BufferCore::latestCommon(const std::string& target, const std::string& source) const {
  const std::vector<std::string> a = ancestors(target), b = ancestors(source);
  const auto common = std::find_first_of(a.begin(), a.end(), b.begin(), b.end());
  if (common == a.end())
    throw ConnectivityException("Could not find a connection between '" + target + "' and '" + source +
                                "' because they are not part of the same tree.Tf has two or more unconnected trees.");
  ros::Time latest = ros::TIME_MAX;
  for (const auto* const names : {&a, &b})
    for (const std::string& name : *names) {
      if (name == *common) break;
      const Frame& frame = frames_.at(name);
      if (!frame.is_static) latest = std::min(latest, frame.samples.rbegin()->first);
    }
  return latest == ros::TIME_MAX ? ros::Time() : latest;
}

std::string BufferCore::checked(const std::string& frame, const char* what) const {
  if (frame.empty())
    throw InvalidArgumentException(std::string("Invalid argument passed to ") + what +
                                   " in tf2 frame_ids cannot be empty");
  const std::string name = stripped(frame);
  if (!names_.count(name)) throw LookupException("\"" + name + "\" passed to " + what + " does not exist. ");
  return name;
}

BufferCore::Motion BufferCore::lookUp(const std::string& target, const std::string& source, ros::Time& time) const {
  if (target == source) {
    if (time.isZero() && frames_.count(target) && !frames_.at(target).samples.empty())
      time = frames_.at(target).samples.rbegin()->first;
    return Motion::identity();
  }
  if (time.isZero()) time = latestCommon(target, source);
  const Chain a = chainUp(target, time, source), b = chainUp(source, time, target);
  for (const auto& left : a.frames)
    for (const auto& right : b.frames)
      if (left.first == right.first) return left.second.inverse() * right.second;
  latestCommon(target, source);  // throws for separate trees
  throw ExtrapolationException((a.fault.find("extrapolation") != std::string::npos ? a.fault : b.fault) +
                               ", when looking up transform from frame [" + source + "] to frame [" + target + "]");
}

geometry_msgs::TransformStamped BufferCore::lookupTransform(const std::string& target_frame,
                                                            const std::string& source_frame,
                                                            const ros::Time& time) const {
  const std::lock_guard<std::recursive_mutex> lock(mutex_);
  if (target_frame == source_frame) {  // also of a frame that nobody has sent yet
    ros::Time at = time;
    const Motion identity = lookUp(target_frame, source_frame, at);
    return message(identity, at, target_frame, source_frame);
  }
  const std::string target = checked(target_frame, "lookupTransform argument target_frame"),
                    source = checked(source_frame, "lookupTransform argument source_frame");
  ros::Time at = time;
  const Motion motion = lookUp(target, source, at);
  return message(motion, at, target_frame, source_frame);
}

geometry_msgs::TransformStamped BufferCore::lookupTransform(const std::string& target_frame,
                                                            const ros::Time& target_time,
                                                            const std::string& source_frame,
                                                            const ros::Time& source_time,
                                                            const std::string& fixed_frame) const {
  const std::lock_guard<std::recursive_mutex> lock(mutex_);
  const std::string target = checked(target_frame, "lookupTransform argument target_frame"),
                    source = checked(source_frame, "lookupTransform argument source_frame"),
                    fixed = checked(fixed_frame, "lookupTransform argument fixed_frame");
  ros::Time at_source = source_time, at_target = target_time;
  const Motion from_source = lookUp(fixed, source, at_source);
  const Motion to_target = lookUp(target, fixed, at_target);
  return message(to_target * from_source, at_target, target_frame, source_frame);
}

bool BufferCore::canTransform(const std::string& target_frame, const std::string& source_frame, const ros::Time& time,
                              std::string* error_msg) const {
  try {
    lookupTransform(target_frame, source_frame, time);
    return true;
  } catch (const TransformException& error) {
    if (error_msg) *error_msg = error.what();
    return false;
  }
}

bool BufferCore::canTransform(const std::string& target_frame, const ros::Time& target_time,
                              const std::string& source_frame, const ros::Time& source_time,
                              const std::string& fixed_frame, std::string* error_msg) const {
  try {
    lookupTransform(target_frame, target_time, source_frame, source_time, fixed_frame);
    return true;
  } catch (const TransformException& error) {
    if (error_msg) *error_msg = error.what();
    return false;
  }
}

void BufferCore::getFrameStrings(std::vector<std::string>& frames) const {
  const std::lock_guard<std::recursive_mutex> lock(mutex_);
  frames.resize(names_.size());
  for (const auto& entry : names_) frames[entry.second] = entry.first;
}

bool BufferCore::frameExists(const std::string& frame) const {
  const std::lock_guard<std::recursive_mutex> lock(mutex_);
  return names_.count(stripped(frame)) > 0;
}

bool BufferCore::getParent(const std::string& frame, ros::Time time, std::string& parent) const {
  const std::lock_guard<std::recursive_mutex> lock(mutex_);
  const auto found = frames_.find(stripped(frame));
  Sample sample;
  std::string fault;
  if (found == frames_.end() || !find(found->second, frame, time, sample, fault)) return false;
  parent = sample.parent;
  return true;
}

ros::Time BufferCore::getLatestCommonTime(const std::string& target_frame, const std::string& source_frame) const {
  const std::lock_guard<std::recursive_mutex> lock(mutex_);
  return latestCommon(checked(target_frame, "getLatestCommonTime"), checked(source_frame, "getLatestCommonTime"));
}

std::string BufferCore::allFramesAsString() const {
  const std::lock_guard<std::recursive_mutex> lock(mutex_);
  std::string all;
  for (const auto& entry : frames_)
    if (!entry.second.samples.empty())
      all += "Frame " + entry.first + " exists with parent " + entry.second.samples.rbegin()->second.parent + ".\n";
  return all;
}

std::string BufferCore::allFramesAsYAML() const {
  const std::lock_guard<std::recursive_mutex> lock(mutex_);
  std::string all;
  for (const auto& entry : frames_) {
    if (entry.second.samples.empty()) continue;
    const auto& samples = entry.second.samples;
    all += entry.first + ": \n  parent: '" + samples.rbegin()->second.parent + "'\n  broadcaster: '" +
           entry.second.authority + "'\n  most_recent_transform: " + text(samples.rbegin()->first) +
           "\n  oldest_transform: " + text(samples.begin()->first) + "\n";
  }
  return all.empty() ? "{}" : all;
}

}  // namespace tf2
