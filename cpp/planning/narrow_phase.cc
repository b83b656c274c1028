#include "narrow_phase.h"

#include <algorithm>
#include <stdexcept>

#include <mujoco/mujoco.h>

namespace trundle::planning {

GeomDistance geom_distance = nullptr;

namespace {

constexpr int kMaxTurns = 6;

Vec3 support(const ConvexShape& shape, const Rigid& pose, const Vec3& direction) {
  return pose * shape.support(unrotate(pose.r, direction));
}

// Look for a separating direction (Chung and Wang 1996): each failed one is mirrored at the supports' difference. One
// that is found proves it; none within some turns proves nothing.
bool find_separation(const ConvexShape& a, const Rigid& pose_a, const ConvexShape& b, const Rigid& pose_b,
                     double margin) {
  Vec3 direction = pose_b * b.center - pose_a * a.center;
  double length = norm(direction);
  if (length < 1e-12) return false;
  direction = (1.0 / length) * direction;
  for (int turn = 0; turn < kMaxTurns; ++turn) {
    const Vec3 gap = support(b, pose_b, -1.0 * direction) - support(a, pose_a, direction);
    const double along = dot(direction, gap);
    if (along > margin) return true;
    length = norm(gap);
    if (length < 1e-12) return false;
    const Vec3 unit = (1.0 / length) * gap;
    direction = direction - (2.0 * dot(direction, unit)) * unit;
    length = norm(direction);
    if (length < 1e-12) return false;
    direction = (1.0 / length) * direction;
  }
  return false;
}

}  // namespace

NarrowPhase::NarrowPhase(mjModel_* model, mjData_* data) : model_(model), data_(data) {
  if (model_->ngeom != 4 || model_->nmesh != 2 || model_->mesh_vertnum[0] != model_->mesh_vertnum[1])
    throw std::invalid_argument("this is no model of a pair of shapes");
  capacity_ = static_cast<std::size_t>(model_->mesh_vertnum[0]);
}

int NarrowPhase::place(int side, const ConvexShape& shape, const Rigid& pose) {
  const bool is_hull = shape.kind == ShapeKind::kHull;
  const int geom = is_hull ? 2 + side : side;
  if (is_hull) {
    const std::size_t count = std::min(shape.corners.size() / 3, capacity_);
    std::uint64_t& held = held_[static_cast<std::size_t>(side)];
    if (held != shape.id) {
      std::copy_n(shape.corners.data(), 3 * count, model_->mesh_vert + 3 * model_->mesh_vertadr[side]);
      model_->mesh_vertnum[side] = static_cast<int>(count);
      held = shape.id;
    }
  } else {
    model_->geom_type[geom] = static_cast<int>(shape.kind);
    std::copy_n(shape.size.data(), 3, model_->geom_size + 3 * geom);
  }
  model_->geom_rbound[geom] = shape.radius;
  const Vec3 center = pose * shape.center;
  const double position[3] = {center.x, center.y, center.z};
  std::copy_n(position, 3, data_->geom_xpos + 3 * geom);
  std::copy_n(pose.r.m.data(), 9, data_->geom_xmat + 9 * geom);
  return geom;
}

double NarrowPhase::distance(const ConvexShape& a, const Rigid& pose_a, const ConvexShape& b, const Rigid& pose_b,
                             double cutoff, Vec3* on_a, Vec3* on_b) {
  if (a.kind == ShapeKind::kPlane || b.kind == ShapeKind::kPlane) {
    if (a.kind == ShapeKind::kPlane && b.kind == ShapeKind::kPlane) return cutoff;  // what never moves
    const double away = a.kind == ShapeKind::kPlane ? plane_distance(pose_a, b, pose_b, on_a, on_b)
                                                    : plane_distance(pose_b, a, pose_a, on_b, on_a);
    return std::min(away, cutoff);
  }
  const int geom_a = place(0, a, pose_a), geom_b = place(1, b, pose_b);
  double segment[6]{};
  const double away = geom_distance(model_, data_, geom_a, geom_b, cutoff, segment);
  if (on_a) *on_a = {segment[0], segment[1], segment[2]};
  if (on_b) *on_b = {segment[3], segment[4], segment[5]};
  return away;
}

bool NarrowPhase::is_apart(const ConvexShape& a, const Rigid& pose_a, const ConvexShape& b, const Rigid& pose_b,
                           double margin) {
  if (a.kind != ShapeKind::kPlane && b.kind != ShapeKind::kPlane && find_separation(a, pose_a, b, pose_b, margin))
    return true;
  // A little more than the margin, so that a distance at the cutoff is apart.
  return distance(a, pose_a, b, pose_b, margin + 1e-9) > margin;
}

double plane_distance(const Rigid& plane, const ConvexShape& shape, const Rigid& pose, Vec3* on_plane, Vec3* on_shape) {
  const Vec3 normal = plane.r.column(2);
  const Vec3 lowest = support(shape, pose, -1.0 * normal), highest = support(shape, pose, normal);
  const double low = dot(normal, lowest - plane.p), high = dot(normal, highest - plane.p);
  const bool is_above = low + high >= 0.0;
  const double away = is_above ? low : -high;
  const Vec3 nearest = is_above ? lowest : highest;
  if (on_shape) *on_shape = nearest;
  if (on_plane) *on_plane = nearest - (is_above ? low : high) * normal;
  return away;
}

}  // namespace trundle::planning
