#include "tf2_ros/buffer_client.h"
#include "tf2_ros/buffer_server.h"

namespace tf2_ros {
namespace {

typedef tf2_msgs::TF2Error Error;

uint8_t codeOf(const tf2::TransformException& error) {
  if (dynamic_cast<const tf2::ConnectivityException*>(&error)) return Error::CONNECTIVITY_ERROR;
  if (dynamic_cast<const tf2::ExtrapolationException*>(&error)) return Error::EXTRAPOLATION_ERROR;
  if (dynamic_cast<const tf2::InvalidArgumentException*>(&error)) return Error::INVALID_ARGUMENT_ERROR;
  if (dynamic_cast<const tf2::LookupException*>(&error)) return Error::LOOKUP_ERROR;
  return Error::TRANSFORM_ERROR;
}

[[noreturn]] void raise(const Error& error) {
  switch (error.error) {
    case Error::LOOKUP_ERROR: throw tf2::LookupException(error.error_string);
    case Error::CONNECTIVITY_ERROR: throw tf2::ConnectivityException(error.error_string);
    case Error::EXTRAPOLATION_ERROR: throw tf2::ExtrapolationException(error.error_string);
    case Error::INVALID_ARGUMENT_ERROR: throw tf2::InvalidArgumentException(error.error_string);
    case Error::TIMEOUT_ERROR: throw tf2::TimeoutException(error.error_string);
    default: throw tf2::TransformException(error.error_string);
  }
}

geometry_msgs::TransformStamped lookUp(const Buffer& buffer, const tf2_msgs::LookupTransformGoal& goal) {
  if (goal.advanced)
    return buffer.lookupTransform(goal.target_frame, goal.target_time, goal.source_frame, goal.source_time,
                                  goal.fixed_frame);
  return buffer.lookupTransform(goal.target_frame, goal.source_frame, goal.source_time);
}

}  // namespace

BufferClient::BufferClient(std::string ns, double, ros::Duration timeout_padding)
    : client_(ns), timeout_padding_(timeout_padding) {}

geometry_msgs::TransformStamped BufferClient::ask(const tf2_msgs::LookupTransformGoal& goal) const {
  client_.sendGoal(goal);
  if (!client_.waitForResult(goal.timeout + timeout_padding_)) {
    client_.cancelGoal();
    throw tf2::TimeoutException("the buffer's server did not answer within the timeout");
  }
  if (client_.getState() != actionlib::SimpleClientGoalState::SUCCEEDED)
    throw tf2::TimeoutException("the buffer's server did not look the transform up: " + client_.getState().toString());
  const tf2_msgs::LookupTransformResultConstPtr result = client_.getResult();
  if (result->error.error != Error::NO_ERROR) raise(result->error);
  return result->transform;
}

geometry_msgs::TransformStamped BufferClient::lookupTransform(const std::string& target_frame,
                                                              const std::string& source_frame, const ros::Time& time,
                                                              const ros::Duration timeout) const {
  tf2_msgs::LookupTransformGoal goal;
  goal.target_frame = target_frame;
  goal.source_frame = source_frame;
  goal.source_time = time;
  goal.timeout = timeout;
  return ask(goal);
}

geometry_msgs::TransformStamped BufferClient::lookupTransform(
    const std::string& target_frame, const ros::Time& target_time, const std::string& source_frame,
    const ros::Time& source_time, const std::string& fixed_frame, const ros::Duration timeout) const {
  tf2_msgs::LookupTransformGoal goal;
  goal.target_frame = target_frame;
  goal.target_time = target_time;
  goal.source_frame = source_frame;
  goal.source_time = source_time;
  goal.fixed_frame = fixed_frame;
  goal.advanced = true;
  goal.timeout = timeout;
  return ask(goal);
}

bool BufferClient::canTransform(const std::string& target_frame, const std::string& source_frame, const ros::Time& time,
                                const ros::Duration timeout, std::string* errstr) const {
  try {
    lookupTransform(target_frame, source_frame, time, timeout);
    return true;
  } catch (const tf2::TransformException& error) {
    if (errstr) *errstr = error.what();
    return false;
  }
}

bool BufferClient::canTransform(const std::string& target_frame, const ros::Time& target_time,
                                const std::string& source_frame, const ros::Time& source_time,
                                const std::string& fixed_frame, const ros::Duration timeout,
                                std::string* errstr) const {
  try {
    lookupTransform(target_frame, target_time, source_frame, source_time, fixed_frame, timeout);
    return true;
  } catch (const tf2::TransformException& error) {
    if (errstr) *errstr = error.what();
    return false;
  }
}

BufferServer::BufferServer(const Buffer& buffer, const std::string& ns, bool auto_start, ros::Duration check_period)
    : buffer_(buffer),
      server_(
          ros::NodeHandle(), ns, [this](GoalHandle handle) { onGoal(handle); },
          [this](GoalHandle handle) { onCancel(handle); }, auto_start),
      timer_(ros::NodeHandle().createTimer(check_period, [this](const ros::TimerEvent&) { check(); })) {}

void BufferServer::onGoal(GoalHandle handle) {
  handle.setAccepted("");
  const ros::Time end = ros::Time::now() + handle.getGoal()->timeout;
  if (answer(handle, end)) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  pending_.push_back({handle, end});
}

void BufferServer::onCancel(GoalHandle handle) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (auto pending = pending_.begin(); pending != pending_.end(); ++pending) {
    if (!(pending->handle == handle)) continue;
    handle.setCanceled();
    pending_.erase(pending);
    return;
  }
}

void BufferServer::check() {
  const std::lock_guard<std::mutex> lock(mutex_);
  pending_.remove_if([this](Pending& pending) { return answer(pending.handle, pending.end); });
}

bool BufferServer::answer(GoalHandle& handle, const ros::Time& end) {
  tf2_msgs::LookupTransformResult result;
  try {
    result.transform = lookUp(buffer_, *handle.getGoal());
  } catch (const tf2::TransformException& error) {
    if (ros::Time::now() < end) return false;
    result.error.error = codeOf(error);
    result.error.error_string = error.what();
  }
  handle.setSucceeded(result);
  return true;
}

}  // namespace tf2_ros
