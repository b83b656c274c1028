#include "servo_laws.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace trundle {

namespace {

// Segment at a time, or the first one.
const PathSegment& segment_at(const JointPath& path, std::int64_t time_ns) {
  const auto starts_later = [](std::int64_t time, const PathSegment& segment) { return time < segment.start_ns; };
  const auto next = std::upper_bound(path.begin(), path.end(), time_ns, starts_later);
  return next == path.begin() ? *next : *(next - 1);
}

MotionState evaluate(const std::array<double, 6>& c, double t) {
  return {c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * (c[4] + t * c[5])))),
          c[1] + t * (2 * c[2] + t * (3 * c[3] + t * (4 * c[4] + t * 5 * c[5]))),
          2 * c[2] + t * (6 * c[3] + t * (12 * c[4] + t * 20 * c[5]))};
}

MotionState sample(const PathSegment& segment, std::int64_t time_ns) {
  const std::int64_t nearest_ns = std::clamp(time_ns, segment.start_ns, segment.end_ns);
  const MotionState state = evaluate(segment.coefficients, static_cast<double>(nearest_ns - segment.start_ns) / 1e9);
  return nearest_ns == time_ns ? state : MotionState{state.position, 0.0, 0.0};
}

bool is_beyond(double tolerance, double error) { return 0.0 < tolerance && tolerance < std::abs(error); }

}  // namespace

void ServoLaw::mark_update(std::int64_t time, double dt) {
  time_ns = time;
  period_ns = static_cast<std::int64_t>(std::nearbyint(dt * 1e9));
}

void PidLoop::start(std::int64_t time) {
  time_ns = time;
  period_ns = 0;
  joint_->start();
  pid_->reset();
  target = of_speed_ ? 0.0 : joint_->position;
}

double PidLoop::error() {
  if (of_speed_) return target - joint_->velocity;
  target = std::min(std::max(target, joint_->traits().lower), joint_->traits().upper);
  return joint_->error(target);
}

bool PidLoop::update(std::int64_t time, double dt) {
  mark_update(time, dt);
  joint_->command = pid_->command(error(), dt);
  ++updates;
  return true;
}

std::function<void()> PidLoop::checkpoint() {
  return [this, saved = *this, pid = *pid_] {
    *this = saved;
    *pid_ = pid;
  };
}

bool StateTolerance::allows(double position_error, double velocity_error) const {
  return !(is_beyond(position, position_error) || is_beyond(velocity, velocity_error));
}

TrajectoryLaw::TrajectoryLaw(std::vector<std::shared_ptr<ServoJoint>> joints,
                             std::vector<std::shared_ptr<ToolboxPid>> pids, std::vector<double> forward)
    : joints_(std::move(joints)),
      pids_(std::move(pids)),
      forward_(std::move(forward)),
      desired_(joints_.size()),
      arrived_(joints_.size()) {
  const bool fits = forward_.size() == joints_.size() && (pids_.empty() || pids_.size() == joints_.size());
  if (!fits || joints_.empty()) throw std::invalid_argument("as many PIDs and gains as joints");
}

void TrajectoryLaw::set_paths(std::vector<std::shared_ptr<const JointPath>> paths) {
  const auto is_empty = [](const std::shared_ptr<const JointPath>& path) { return !path || path->empty(); };
  if (paths.size() != joints_.size() || std::any_of(paths.begin(), paths.end(), is_empty))
    throw std::invalid_argument("a path for each joint");
  paths_ = std::move(paths);
}

void TrajectoryLaw::begin_goal(std::int64_t goal) {
  goal_ = goal;
  arrived_.assign(joints_.size(), false);
}

std::optional<TrajectoryLaw::Event> TrajectoryLaw::take_event() { return std::exchange(event_, {}); }

void TrajectoryLaw::start(std::int64_t time) {
  time_ns = time;
  period_ns = 0;
  for (std::size_t i = 0; i < joints_.size(); ++i) desired_[i] = {joints_[i]->position, joints_[i]->velocity, 0.0};
}

bool TrajectoryLaw::update(std::int64_t time, double dt) {
  mark_update(time, dt);
  std::vector<const PathSegment*> segments(joints_.size());
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    segments[i] = &segment_at(*paths_[i], time);
    desired_[i] = sample(*segments[i], time);
  }
  if (watches && (event_ = check(segments))) watches = false;
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    ServoJoint& joint = *joints_[i];
    const MotionState& desired = desired_[i];
    if (pids_.empty()) {
      joint.command = desired.position;
      continue;
    }
    const double slope = desired.velocity - joint.velocity;
    const double command = pids_[i]->command(joint.shortest_error(desired.position), dt, slope);
    joint.command = command + forward_[i] * desired.velocity;
  }
  return !event_;
}

// Result of the goal once a joint has left its path or missed its end, or all have reached it.
std::optional<TrajectoryLaw::Event> TrajectoryLaw::check(const std::vector<const PathSegment*>& segments) {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const PathSegment& on = *segments[i];
    if (on.goal != goal_) continue;
    const double error = joints_[i]->shortest_error(desired_[i].position);
    const double velocity_error = desired_[i].velocity - joints_[i]->velocity;
    if (time_ns < on.end_ns) {
      if (!on.along.allows(error, velocity_error)) return Event{Outcome::kOffPath, i, error};
    } else if (&on == &paths_[i]->back()) {
      if (on.at_end.allows(error, velocity_error)) arrived_[i] = true;
      else if (time_ns >= on.end_ns + on.tolerance_ns + joints_[i]->settling_ns())
        return Event{Outcome::kMissed, i, error};
    }
  }
  const bool all = std::find(arrived_.begin(), arrived_.end(), false) == arrived_.end();
  return all ? std::optional(Event{Outcome::kReached, 0, 0.0}) : std::nullopt;
}

std::function<void()> TrajectoryLaw::checkpoint() {
  std::vector<ToolboxPid> pids;
  for (const auto& pid : pids_) pids.push_back(*pid);
  return [this, saved = *this, pids] {
    *this = saved;
    for (std::size_t i = 0; i < pids.size(); ++i) *pids_[i] = pids[i];
  };
}

}  // namespace trundle
