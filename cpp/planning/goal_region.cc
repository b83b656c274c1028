#include "goal_region.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <utility>

namespace trundle::planning {

namespace {

Rotation rotation_by(const PoseConstraint& constraint, const Vec3& angles) {
  if (constraint.orientation == OrientationError::kEuler)
    return rotation_about({1, 0, 0}, angles.x) * rotation_about({0, 1, 0}, angles.y) *
           rotation_about({0, 0, 1}, angles.z);
  const double angle = norm(angles);
  return angle > 1e-12 ? rotation_about((1.0 / angle) * angles, angle) : Rotation{};
}

// The constraint with one pose of those that it allows.
PoseConstraint narrowed(const PoseConstraint& constraint, Random& random) {
  PoseConstraint exact = constraint;
  if (!constraint.regions.empty()) {
    const Piece& region = constraint.regions[random.index(constraint.regions.size())];
    const Vec3 point = region.pose * sample_point(*region.shape, random);
    exact.regions = {{std::make_shared<ConvexShape>(make_primitive(ShapeKind::kSphere, {})), {{}, point}}};
  }
  if (constraint.orientation != OrientationError::kNone) {
    // About an axis whose angle is free the angle stays so: the arm chooses it.
    const auto free = [](double tolerance) { return tolerance >= std::numbers::pi; };
    const auto [x, y, z] = constraint.tolerance;
    const auto angle = [&](double tolerance) { return free(tolerance) ? 0.0 : random.uniform(-tolerance, tolerance); };
    exact.target = constraint.target * rotation_by(constraint, {angle(x), angle(y), angle(z)});
    exact.tolerance = {free(x) ? x : 0.0, free(y) ? y : 0.0, free(z) ? z : 0.0};
  }
  return exact;
}

}  // namespace

Vec3 sample_point(const ConvexShape& region, Random& random) {
  const auto& size = region.size;
  switch (region.kind) {
    case ShapeKind::kBox:
      return {random.uniform(-size[0], size[0]), random.uniform(-size[1], size[1]), random.uniform(-size[2], size[2])};
    case ShapeKind::kSphere: {
      const Vec3 v{random.gaussian(), random.gaussian(), random.gaussian()};
      const double length = norm(v);
      return length > 0.0 ? (size[0] * std::cbrt(random.uniform()) / length) * v : v;
    }
    case ShapeKind::kCylinder: {
      const double radius = size[0] * std::sqrt(random.uniform());
      const double turn = random.uniform(-std::numbers::pi, std::numbers::pi);
      return {radius * std::cos(turn), radius * std::sin(turn), random.uniform(-size[1], size[1])};
    }
    case ShapeKind::kPlane: return {};
    default: {
      Vec3 point = region.support({random.gaussian(), random.gaussian(), random.gaussian()});
      for (int i = 0; i < 3; ++i) {
        const Vec3 corner = region.support({random.gaussian(), random.gaussian(), random.gaussian()});
        point = point + random.uniform() * (corner - point);
      }
      return point;
    }
  }
}

bool JointBound::holds(double value, bool is_circle) const {
  const double away = is_circle ? std::remainder(value - center, 2.0 * std::numbers::pi) : value - center;
  return away >= lower - center - 1e-6 && away <= upper - center + 1e-6;
}

GoalRegion::GoalRegion(std::vector<Goal> goals, std::span<const double> start)
    : goals_(std::move(goals)), start_(start.begin(), start.end()) {}

bool GoalRegion::sample(Validity& validity, Random& random, std::span<double> out) {
  if (goals_.empty()) return false;
  const long long turn = attempts++ / static_cast<long long>(goals_.size());
  const Goal& goal = goals_[static_cast<std::size_t>(attempts - 1) % goals_.size()];
  // The first one is near the start, then near it by chance, then anywhere.
  validity.space().sample(random, out);
  const double mix = turn == 0 ? 0.0 : turn % 2 == 1 ? 0.3 : 1.0;
  if (mix < 1.0) validity.space().interpolate(start_, out, mix, out);
  for (const JointBound& joint : goal.joints)
    out[joint.variable] = turn == 0 ? joint.center : random.uniform(joint.lower, joint.upper);
  validity.space().clamp(out);
  if (!goal.constraints.poses.empty() || validity.is_constrained()) {
    std::vector<PoseConstraint> exact;
    for (const PoseConstraint& constraint : goal.constraints.poses) exact.push_back(narrowed(constraint, random));
    // An arm of few joints reaches no pose exactly, but some within the tolerances.
    if (!validity.project(out, exact) && !validity.project(out, goal.constraints.poses)) {
      ++unreachable;
      return false;
    }
  }
  if (!is_satisfied(validity, out)) {
    ++unreachable;
    return false;
  }
  if (!validity.is_valid(out)) {
    ++in_collision;
    return false;
  }
  return true;
}

bool GoalRegion::is_satisfied(Validity& validity, std::span<const double> group) const {
  std::vector<Rigid> poses;
  const State& state = validity.full(group);
  validity.world().tree().compute(state, poses);
  return std::any_of(goals_.begin(), goals_.end(), [&](const Goal& goal) {
    for (const JointBound& joint : goal.joints)
      if (!joint.holds(group[joint.variable], validity.space().dimensions()[joint.variable].is_circle)) return false;
    for (const PoseConstraint& constraint : goal.constraints.poses)
      if (!planning::is_satisfied(constraint, poses, 1e-5)) return false;
    for (const VisibilityConstraint& constraint : goal.constraints.visibilities)
      if (!planning::is_satisfied(constraint, validity.world(), state)) return false;
    return true;
  });
}

}  // namespace trundle::planning
