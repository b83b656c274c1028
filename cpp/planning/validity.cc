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
  find_reach();
}

// An upper bound: the way along the links from a joint to the farthest point of what it moves.
void Validity::find_reach() {
  const LinkTree& tree = world_.tree();
  std::vector<double> below(tree.size(), 0.0);  // from a link's origin to the farthest point below it
  for (const auto& [number, body] : world_.bodies()) {
    if (body.link < 0) continue;
    double& farthest = below[static_cast<std::size_t>(body.link)];
    for (const Piece& piece : body.pieces)
      farthest = std::max(farthest, norm(piece.pose * piece.shape->center) + piece.shape->radius);
  }
  for (std::size_t i = tree.size(); i-- > 0;) {
    const TreeJoint& joint = tree.joint(i);
    if (joint.parent < 0) continue;
    double away = norm(joint.origin.p);
    if (joint.kind == JointKind::kPrismatic) {
      for (std::size_t k = 0; k < task_.variables.size(); ++k)
        if (task_.variables[k] == joint.variable) {
          const Dimension& dimension = task_.space.dimensions()[k];
          away += std::max(std::abs(dimension.lower), std::abs(dimension.upper));
        }
    }
    double& parent = below[static_cast<std::size_t>(joint.parent)];
    parent = std::max(parent, away + below[i]);
  }
  reach_.assign(task_.variables.size(), 0.0);
  for (std::size_t i = 0; i < tree.size(); ++i) {
    const TreeJoint& joint = tree.joint(i);
    for (std::size_t k = 0; k < task_.variables.size(); ++k) {
      const int variable = task_.variables[k];
      if (joint.kind == JointKind::kRevolute && (joint.leader < 0 ? joint.variable : joint.leader) == variable)
        reach_[k] = std::max(reach_[k], std::abs(joint.leader < 0 ? 1.0 : joint.multiplier) * below[i]);
      else if (joint.kind == JointKind::kPrismatic && (joint.leader < 0 ? joint.variable : joint.leader) == variable)
        reach_[k] = std::max(reach_[k], 1.0);
      else if (joint.kind == JointKind::kPlanar && variable >= joint.variable && variable < joint.variable + 3)
        reach_[k] = std::max(reach_[k], variable == joint.variable + 2 ? below[i] : 1.0);
      else if (joint.kind == JointKind::kFloating && variable >= joint.variable && variable < joint.variable + 7)
        reach_[k] = std::max(reach_[k], variable >= joint.variable + 3 ? 2.0 * below[i] : 1.0);
    }
  }
}

const State& Validity::full(std::span<const double> group) {
  for (std::size_t k = 0; k < group.size(); ++k) full_[static_cast<std::size_t>(task_.variables[k])] = group[k];
  return full_;
}

bool Validity::is_free(std::span<const double> group, double margin) {
  ++checks;
  return !task_.avoids_collisions || world_.is_free(full(group), task_.mask.empty() ? nullptr : &task_.mask, margin);
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

double Validity::swept(std::span<const double> a, std::span<const double> b) const {
  double way = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    double apart = std::abs(b[k] - a[k]);
    if (task_.space.dimensions()[k].is_circle) apart = std::min(apart, 2.0 * std::numbers::pi - apart);
    way += reach_[k] * apart;
  }
  return way;
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
  const double way = swept(a, b);
  for (int i = 0; i < count; ++i)
    if (!is_part_valid(a, b, static_cast<double>(i) / count, static_cast<double>(i + 1) / count, way)) return false;
  return true;
}

// If everything is farther away in the middle than any point moves from there, nothing is touched.
bool Validity::is_part_valid(std::span<const double> a, std::span<const double> b, double from, double to,
                             double swept) {
  const double middle = 0.5 * (from + to), half = 0.5 * (to - from) * swept;
  task_.space.interpolate(a, b, middle, between_);
  if (!keeps_constraints(between_)) return false;
  if (is_free(between_, half)) return true;
  if (!is_free(between_)) return false;
  if (2.0 * half <= task_.sweep) return true;
  return is_part_valid(a, b, from, middle, swept) && is_part_valid(a, b, middle, to, swept);
}

}  // namespace trundle::planning
