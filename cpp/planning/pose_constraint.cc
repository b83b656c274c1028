#include "pose_constraint.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trundle::planning {

namespace {

constexpr int kNearestTurns = 64;

Rigid frame_pose(int link, const std::vector<Rigid>& poses) {
  return link < 0 ? Rigid{} : poses[static_cast<std::size_t>(link)];
}

// Angles a, b, c of R = Rx(a) Ry(b) Rz(c).
Vec3 euler_angles(const Rotation& r) {
  const double b = std::asin(std::clamp(r.m[2], -1.0, 1.0));
  if (std::abs(r.m[2]) > 1.0 - 1e-9) return {std::atan2(r.m[3], r.m[4]), b, 0.0};
  return {std::atan2(-r.m[5], r.m[8]), b, std::atan2(-r.m[1], r.m[0])};
}

// Of the two triples of angles of one rotation, the one with the smaller largest violation is meant.
Vec3 angles_within(const Rotation& r, const Vec3& tolerance) {
  const Vec3 first = euler_angles(r);
  const auto turned = [](double angle) { return angle > 0.0 ? angle - std::numbers::pi : angle + std::numbers::pi; };
  const double flip = first.y > 0.0 ? std::numbers::pi - first.y : -std::numbers::pi - first.y;
  const Vec3 second{turned(first.x), flip, turned(first.z)};
  const auto beyond = [&](const Vec3& v) {
    return std::max({std::abs(v.x) - tolerance.x, std::abs(v.y) - tolerance.y, std::abs(v.z) - tolerance.z, 0.0});
  };
  return beyond(second) < beyond(first) ? second : first;
}

double beyond(double value, double tolerance) {
  return value > tolerance ? value - tolerance : value < -tolerance ? value + tolerance : 0.0;
}

// Rows that turn an angular velocity in the target's frame into the rates of the angles of `angles_within`.
void euler_rates(const Vec3& angles, std::array<Vec3, 3>& rows) {
  const double sa = std::sin(angles.x), ca = std::cos(angles.x), cb = std::cos(angles.y);
  const double safe = std::abs(cb) < 1e-3 ? std::copysign(1e-3, cb) : cb;
  const double tb = std::sin(angles.y) / safe;
  // omega = x a' + Rx y b' + Rx Ry z c', with Rx y = (0, ca, sa), Rx Ry z = (sb, -sa cb, ca cb).
  rows[2] = {0.0, -sa / safe, ca / safe};
  rows[1] = {0.0, ca, sa};
  rows[0] = {1.0, sa * tb, -ca * tb};
}

// The same for rotation vectors: the inverse of the left Jacobian of SO(3).
void vector_rates(const Vec3& v, std::array<Vec3, 3>& rows) {
  const double square = dot(v, v), angle = std::sqrt(square);
  const double sine = std::sin(angle);
  const double c = angle < 1e-4 || std::abs(sine) < 1e-9
                       ? 1.0 / 12.0
                       : 1.0 / square - (1.0 + std::cos(angle)) / (2.0 * angle * sine);
  // 1 - [v]/2 + c [v]², with [v]² = v vᵀ - |v|².
  const double d = 1.0 - c * square;
  rows[0] = {d + c * v.x * v.x, c * v.x * v.y + 0.5 * v.z, c * v.x * v.z - 0.5 * v.y};
  rows[1] = {c * v.x * v.y - 0.5 * v.z, d + c * v.y * v.y, c * v.y * v.z + 0.5 * v.x};
  rows[2] = {c * v.x * v.z + 0.5 * v.y, c * v.y * v.z - 0.5 * v.x, d + c * v.z * v.z};
}

Vec3 angle_errors(const PoseConstraint& constraint, const Rotation& target_from_link) {
  return constraint.orientation == OrientationError::kEuler ? angles_within(target_from_link, constraint.tolerance)
                                                            : rotation_vector(target_from_link);
}

Vec3 position_error(const PoseConstraint& constraint, const Vec3& point) {
  Vec3 best;
  double nearest = 1e300;
  for (const Piece& region : constraint.regions) {
    const Vec3 local = unrotate(region.pose.r, point - region.pose.p);
    const Vec3 error = region.pose.r * (local - nearest_point(*region.shape, local));
    if (dot(error, error) < nearest) {
      nearest = dot(error, error);
      best = error;
    }
  }
  return best;
}

// Solve (A + damping) x = b in place by Cholesky; A is symmetric, n by n.
bool solve(std::vector<double>& a, std::vector<double>& b, std::size_t n) {
  for (std::size_t j = 0; j < n; ++j) {
    double d = a[j * n + j];
    for (std::size_t k = 0; k < j; ++k) d -= a[j * n + k] * a[j * n + k];
    if (d <= 0.0) return false;
    const double root = std::sqrt(d);
    a[j * n + j] = root;
    for (std::size_t i = j + 1; i < n; ++i) {
      double sum = a[i * n + j];
      for (std::size_t k = 0; k < j; ++k) sum -= a[i * n + k] * a[j * n + k];
      a[i * n + j] = sum / root;
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) b[i] -= a[i * n + k] * b[k];
    b[i] /= a[i * n + i];
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) b[i] -= a[k * n + i] * b[k];
    b[i] /= a[i * n + i];
  }
  return true;
}

}  // namespace

Vec3 nearest_point(const ConvexShape& region, const Vec3& point) {
  switch (region.kind) {
    case ShapeKind::kBox:
      return {std::clamp(point.x, -region.size[0], region.size[0]),
              std::clamp(point.y, -region.size[1], region.size[1]),
              std::clamp(point.z, -region.size[2], region.size[2])};
    case ShapeKind::kSphere: {
      const double length = norm(point);
      return length <= region.size[0] ? point : (region.size[0] / length) * point;
    }
    case ShapeKind::kCylinder: {
      const double length = std::hypot(point.x, point.y);
      const double factor = length <= region.size[0] ? 1.0 : region.size[0] / length;
      return {factor * point.x, factor * point.y, std::clamp(point.z, -region.size[1], region.size[1])};
    }
    case ShapeKind::kPlane: return {point.x, point.y, 0.0};
    default: break;
  }
  // Frank and Wolfe's steps towards the corners that are highest along what is missing.
  Vec3 best = region.support(point - region.center);
  for (int turn = 0; turn < kNearestTurns; ++turn) {
    const Vec3 missing = point - best;
    const Vec3 step = region.support(missing) - best;
    const double gain = dot(missing, step);
    if (gain <= 1e-12) break;
    best = best + std::min(1.0, gain / dot(step, step)) * step;
    if (dot(point - best, point - best) < 1e-14) return point;
  }
  return best;
}

void measure(const PoseConstraint& constraint, const LinkTree& tree, const std::vector<Rigid>& poses,
             std::span<const int> variables, Violation& out, bool wants_gradient) {
  const Rigid& link = poses[static_cast<std::size_t>(constraint.link)];
  const Rigid frame = frame_pose(constraint.frame, poses);
  const bool has_position = !constraint.regions.empty();
  const bool has_orientation = constraint.orientation != OrientationError::kNone;
  const std::size_t rows = 3 * (static_cast<std::size_t>(has_position) + static_cast<std::size_t>(has_orientation));
  out.residuals.assign(rows, 0.0);
  if (wants_gradient) out.gradient.assign(rows * variables.size(), 0.0);
  const Vec3 point = link * constraint.offset;
  std::size_t row = 0;
  if (has_position) {
    const Vec3 error = position_error(constraint, unrotate(frame.r, point - frame.p));
    for (int i = 0; i < 3; ++i) out.residuals[static_cast<std::size_t>(i)] = error[i];
    row = 3;
  }
  const Rotation frame_from_target = constraint.target;
  std::array<Vec3, 3> rates;
  if (has_orientation) {
    const Rotation target_from_link = transpose(frame.r * frame_from_target) * link.r;
    const Vec3 angles = angle_errors(constraint, target_from_link);
    if (constraint.orientation == OrientationError::kEuler) euler_rates(angles, rates);
    else vector_rates(angles, rates);
    for (int i = 0; i < 3; ++i)
      out.residuals[row + static_cast<std::size_t>(i)] = beyond(angles[i], constraint.tolerance[i]);
  }
  if (!wants_gradient) return;
  const std::size_t columns = variables.size();
  for (std::size_t k = 0; k < columns; ++k) {
    Vec3 linear, angular;
    tree.motion_of(constraint.link, point, variables[k], poses, linear, angular);
    if (constraint.frame >= 0) {
      Vec3 frame_linear, frame_angular;
      tree.motion_of(constraint.frame, point, variables[k], poses, frame_linear, frame_angular);
      linear = linear - frame_linear;
      angular = angular - frame_angular;
    }
    if (has_position) {
      const Vec3 along = unrotate(frame.r, linear);
      for (std::size_t i = 0; i < 3; ++i)
        if (out.residuals[i] != 0.0) out.gradient[i * columns + k] = along[static_cast<int>(i)];
    }
    if (has_orientation) {
      const Vec3 turning = unrotate(frame.r * frame_from_target, angular);
      for (std::size_t i = 0; i < 3; ++i)
        if (out.residuals[row + i] != 0.0) out.gradient[(row + i) * columns + k] = dot(rates[i], turning);
    }
  }
}

bool is_satisfied(const PoseConstraint& constraint, const std::vector<Rigid>& poses, double tolerance) {
  const Rigid& link = poses[static_cast<std::size_t>(constraint.link)];
  const Rigid frame = frame_pose(constraint.frame, poses);
  if (!constraint.regions.empty() &&
      norm(position_error(constraint, unrotate(frame.r, link * constraint.offset - frame.p))) > tolerance)
    return false;
  if (constraint.orientation == OrientationError::kNone) return true;
  const Vec3 angles = angle_errors(constraint, transpose(frame.r * constraint.target) * link.r);
  for (int i = 0; i < 3; ++i)
    if (std::abs(angles[i]) > constraint.tolerance[i] + tolerance) return false;
  return true;
}

bool is_satisfied(const VisibilityConstraint& constraint, CollisionWorld& world, std::span<const double> state) {
  if (constraint.radius <= 0.0) return true;
  std::vector<Rigid> poses;
  world.tree().compute(state, poses);
  const Rigid sensor = frame_pose(constraint.sensor_link, poses) * constraint.sensor;
  const Rigid target = frame_pose(constraint.target_link, poses) * constraint.target;
  const Vec3 sight = target.p - sensor.p;
  const double length = norm(sight);
  if (length < 1e-9) return false;
  const Vec3 normal = target.r.column(2), axis = sensor.r.column(constraint.view_axis);
  const auto angle_to = [&](const Vec3& v, double sign) {
    return std::acos(std::clamp(sign * dot(v, sight) / length, -1.0, 1.0));
  };
  if (constraint.max_view_angle > 0.0 && angle_to(normal, -1.0) > constraint.max_view_angle) return false;
  if (constraint.max_range_angle > 0.0 && angle_to(axis, 1.0) > constraint.max_range_angle) return false;
  std::vector<double> corners{sensor.p.x, sensor.p.y, sensor.p.z};
  for (int i = 0; i < constraint.sides; ++i) {
    const double turn = 2.0 * std::numbers::pi * i / constraint.sides;
    const Vec3 rim = target * Vec3{constraint.radius * std::cos(turn), constraint.radius * std::sin(turn), 0.0};
    corners.insert(corners.end(), {rim.x, rim.y, rim.z});
  }
  for (const BodyContact& contact : world.touching(state, make_hull(corners), Rigid{})) {
    const int link = world.bodies().at(contact.a).link;
    if (link != constraint.sensor_link && link != constraint.target_link) return false;
  }
  return true;
}

bool Projection::project(std::span<const PoseConstraint> constraints, State& state, std::span<double> group,
                         int max_steps) {
  const std::size_t n = variables_.size();
  std::vector<double> matrix(n * n), step(n);
  double damping = 1e-6, last = 1e300;
  for (int turn = 0; turn <= max_steps; ++turn) {
    for (std::size_t k = 0; k < n; ++k) state[static_cast<std::size_t>(variables_[k])] = group[k];
    tree_.compute(state, poses_);
    std::fill(matrix.begin(), matrix.end(), 0.0);
    std::fill(step.begin(), step.end(), 0.0);
    double squares = 0.0;
    for (const PoseConstraint& constraint : constraints) {
      measure(constraint, tree_, poses_, variables_, violation_, true);
      for (std::size_t row = 0; row < violation_.residuals.size(); ++row) {
        const double residual = violation_.residuals[row];
        if (residual == 0.0) continue;
        squares += residual * residual;
        const double* gradient = violation_.gradient.data() + row * n;
        for (std::size_t i = 0; i < n; ++i) {
          step[i] -= gradient[i] * residual;
          for (std::size_t j = 0; j <= i; ++j) matrix[i * n + j] += gradient[i] * gradient[j];
        }
      }
    }
    if (squares <= tolerance * tolerance) return true;
    if (turn == max_steps) return false;
    if (squares < last) {  // Levenberg and Marquardt's rule
      damping = std::max(0.3 * damping, 1e-9);
      last = squares;
    } else {
      damping = std::min(10.0 * damping, 10.0);
    }
    for (std::size_t i = 0; i < n; ++i) matrix[i * n + i] += damping + 1e-9;
    if (!solve(matrix, step, n)) return false;
    for (std::size_t k = 0; k < n; ++k) group[k] += std::clamp(step[k], -0.3, 0.3);
    space_.clamp(group);
  }
  return false;
}

}  // namespace trundle::planning
