#include "bondcpp/bond.h"

#include <bond/Constants.h>

#include <random>
#include <sstream>

namespace bond {
namespace {

constexpr double kTick = 0.05;  // [s]

std::string newId() {
  std::random_device random;
  std::stringstream text;
  text << std::hex;
  for (int i = 0; i < 4; ++i) text << random() << (i < 3 ? "-" : "");
  return text.str();
}

ros::SteadyTime after(double seconds) { return ros::SteadyTime::now() + ros::WallDuration(seconds); }

}  // namespace

Bond::Bond(const std::string& topic, const std::string& id, Callback on_broken, Callback on_formed)
    : topic_(topic),
      id_(id),
      instance_id_(newId()),
      on_broken_(on_broken),
      on_formed_(on_formed),
      connect_timeout_(Constants::DEFAULT_CONNECT_TIMEOUT),
      disconnect_timeout_(Constants::DEFAULT_DISCONNECT_TIMEOUT),
      heartbeat_timeout_(Constants::DEFAULT_HEARTBEAT_TIMEOUT),
      heartbeat_period_(Constants::DEFAULT_HEARTBEAT_PERIOD) {}

Bond::~Bond() {
  if (!is_started_) return;
  breakBond();
  waitUntilBroken(ros::WallDuration(kTick));  // the other end is told; it need not agree
  timer_.stop();
  subscriber_.shutdown();
  publisher_.shutdown();
}

void Bond::setFormedCallback(Callback on_formed) {
  const std::lock_guard<std::mutex> lock(mutex_);
  on_formed_ = on_formed;
}

void Bond::setBrokenCallback(Callback on_broken) {
  const std::lock_guard<std::mutex> lock(mutex_);
  on_broken_ = on_broken;
}

void Bond::start() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_started_ = true;
    deadline_ = after(connect_timeout_);
  }
  publisher_ = node_.advertise<bond::Status>(topic_, 5);
  subscriber_ = node_.subscribe(topic_, 30, &Bond::onStatus, this);
  timer_ = node_.createSteadyTimer(ros::WallDuration(kTick), [this](const ros::SteadyTimerEvent&) { onTimer(); });
}

void Bond::onStatus(const bond::StatusConstPtr& status) {
  std::unique_lock<std::mutex> lock(mutex_);
  if (status->id != id_ || status->instance_id == instance_id_) return;
  if (other_id_.empty()) other_id_ = status->instance_id;
  if (status->instance_id != other_id_) {
    ROS_ERROR("More than two nodes have the bond %s", id_.c_str());
    return;
  }
  if (!status->active) {
    if (state_ == kWaiting || state_ == kFormed) publish(false);
    change(lock, kBroken);
    return;
  }
  if (state_ == kFormed || state_ == kWaiting) deadline_ = after(heartbeat_timeout_);
  if (state_ == kBreaking) publish(false);
  if (state_ == kWaiting) change(lock, kFormed);
}

void Bond::onTimer() {
  std::unique_lock<std::mutex> lock(mutex_);
  if (state_ == kBroken) return;
  const ros::SteadyTime now = ros::SteadyTime::now();
  if (now >= deadline_) {
    change(lock, kBroken);
    return;
  }
  if (state_ == kBreaking || now >= next_heartbeat_) {
    publish(state_ != kBreaking);
    next_heartbeat_ = now + ros::WallDuration(heartbeat_period_);
  }
}

/** Change the state, and call back without the lock. */
void Bond::change(std::unique_lock<std::mutex>& lock, State state) {
  if (state_ == state || state_ == kBroken) return;
  state_ = state;
  has_formed_ |= state == kFormed;
  const Callback callback = state == kBroken ? on_broken_ : state == kFormed ? on_formed_ : Callback();
  changed_.notify_all();
  lock.unlock();
  if (callback) callback();
}

void Bond::publish(bool is_active) {
  bond::Status status;
  status.header.stamp = ros::Time::now();
  status.id = id_;
  status.instance_id = instance_id_;
  status.active = is_active;
  status.heartbeat_timeout = static_cast<float>(heartbeat_timeout_);
  status.heartbeat_period = static_cast<float>(heartbeat_period_);
  publisher_.publish(status);
}

bool Bond::waitFor(ros::WallDuration timeout, const boost::function<bool()>& condition) {
  std::unique_lock<std::mutex> lock(mutex_);
  const ros::SteadyTime end = after(timeout.toSec());
  while (!condition() && (timeout.toSec() < 0.0 || ros::SteadyTime::now() < end)) {
    if (!ros::ok()) return false;
    changed_.wait_for(lock, std::chrono::milliseconds(20));
  }
  return condition();
}

bool Bond::waitUntilFormed(ros::WallDuration timeout) {
  waitFor(timeout, [this] { return state_ != kWaiting; });
  const std::lock_guard<std::mutex> lock(mutex_);
  return has_formed_;
}

bool Bond::waitUntilBroken(ros::WallDuration timeout) {
  return waitFor(timeout, [this] { return state_ == kBroken; });
}

bool Bond::isBroken() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return state_ == kBroken;
}

void Bond::breakBond() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (state_ == kBroken || state_ == kBreaking) return;
  state_ = kBreaking;
  deadline_ = after(disconnect_timeout_);
  publish(false);
}

}  // namespace bond
