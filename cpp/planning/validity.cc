#include "validity.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace trundle::planning {

namespace {

constexpr double kInside = 1e-9;
constexpr int kMaxProjection = 60;
constexpr int kMaxParts = 20000;

}  // namespace

Deadline::Deadline(double seconds, std::shared_ptr<std::atomic<bool>> cancelled) : cancelled_(std::move(cancelled)) {
  end_ = std::chrono::steady_clock::now() +
         std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(seconds));
}

bool Deadline::is_over() const {
  return (cancelled_ && cancelled_->load(std::memory_order_relaxed)) || std::chrono::steady_clock::now() >= end_;
}

double Deadline::remaining() const {
  return std::max(0.0, std::chrono::duration<double>(end_ - std::chrono::steady_clock::now()).count());
}

Validity::Validity(CollisionWorld& world, GroupTask task)
    : world_(world),
      task_(std::move(task)),
      full_(task_.reference),
      projection_(world_.tree(), task_.space, task_.variables) {
  std::vector<double> extents;
  for (const Dimension& dimension : task_.space.dimensions())
    extents.push_back(std::max(std::abs(dimension.lower), std::abs(dimension.upper)));
  reach_ = world_.motion_bounds(task_.variables, extents, task_.reference);
}

const State& Validity::full(std::span<const double> group) {
  for (std::size_t k = 0; k < group.size(); ++k) full_[static_cast<std::size_t>(task_.variables[k])] = group[k];
  return full_;
}

bool Validity::is_free(std::span<const double> group) {
  ++checks;
  return !task_.avoids_collisions || world_.is_free(full(group), task_.mask.empty() ? nullptr : &task_.mask);
}

bool Validity::keeps_constraints(std::span<const double> group) {
  if (task_.path.is_empty()) return true;
  const State& state = full(group);
  world_.tree().compute(state, poses_);
  for (const PoseConstraint& constraint : task_.path.poses)
    if (!is_satisfied(constraint, poses_, 1e-5)) return false;
  for (const VisibilityConstraint& constraint : task_.path.visibilities)
    if (!is_satisfied(constraint, world_, state)) return false;
  return true;
}

bool Validity::is_valid(std::span<const double> group) {
  return task_.space.is_within(group, kInside) && keeps_constraints(group) && is_free(group);
}

bool Validity::project(std::span<double> group, std::span<const PoseConstraint> more) {
  if (more.empty()) return projection_.project(task_.path.poses, full_, group, kMaxProjection);
  std::vector<PoseConstraint> all(more.begin(), more.end());
  all.insert(all.end(), task_.path.poses.begin(), task_.path.poses.end());
  return projection_.project(all, full_, group, kMaxProjection);
}

int Validity::parts(std::span<const double> a, std::span<const double> b) const {
  const double count = std::ceil(task_.space.distance(a, b) / task_.resolution);
  return std::max(1, static_cast<int>(std::min(count, static_cast<double>(kMaxParts))));
}

void Validity::find_swept(std::span<const double> a, std::span<const double> b) {
  swept_.bodies.assign(reach_.empty() ? 0 : reach_[0].bodies.size(), 0.0);
  swept_.pairs.assign(reach_.empty() ? 0 : reach_[0].pairs.size(), 0.0);
  for (std::size_t k = 0; k < a.size(); ++k) {
    double apart = std::abs(b[k] - a[k]);
    if (task_.space.dimensions()[k].is_circle) apart = std::min(apart, 2.0 * std::numbers::pi - apart);
    for (std::size_t i = 0; i < swept_.bodies.size(); ++i) swept_.bodies[i] += apart * reach_[k].bodies[i];
    for (std::size_t i = 0; i < swept_.pairs.size(); ++i) swept_.pairs[i] += apart * reach_[k].pairs[i];
  }
  greatest_ = swept_.greatest();
}

bool Validity::is_motion_valid(std::span<const double> a, std::span<const double> b, bool finely) {
  const int count = parts(a, b);
  between_.resize(a.size());
  // In the order of the binary digits read backwards, so that the middles come first.
  int size = 1;
  while (size < count) size *= 2;
  for (int step = size / 2, first = step; step >= 1; step /= 2, first = step)
    for (int i = first; i < size; i += 2 * step) {
      if (i >= count) break;
      task_.space.interpolate(a, b, static_cast<double>(i) / count, between_);
      if (!keeps_constraints(between_) || !is_free(between_)) return false;
    }
  if (!finely) return true;
  if (!task_.avoids_collisions) return true;
  find_swept(a, b);
  return is_part_valid(a, b, 0.0, 1.0);
}

// If everything is farther away in the middle than any point moves from there, nothing is touched.
bool Validity::is_part_valid(std::span<const double> a, std::span<const double> b, double from, double to) {
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
  task_.space.interpolate(a, b, middle, between_);
  ++checks;
  if (world_.is_free_within(full(between_), task_.mask.empty() ? nullptr : &task_.mask, swept_, half)) return true;
  if (!is_free(between_)) return false;
  if (2.0 * half * greatest_ <= task_.sweep) return keeps_constraints(between_);
  return is_part_valid(a, b, from, middle) && is_part_valid(a, b, middle, to);
}

}  // namespace trundle::planning
