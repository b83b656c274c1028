// Ray casting into a scene: targets for the kernel.
#include <cmath>

#include "renderer.h"

namespace trundle {

// Target of rays from an origin for a shape; false if no ray can reach it.
bool Renderer::make_target(const Transform& world_from_origin, size_t index, double max_range,
                           RayTarget& target) const {
  const ShapeSpec& shape = scene_.shapes[index];
  const Bounds& bounds = bounds_[index];
  if (!shape_poses_[index] || (shape.kind == ShapeKind::kMesh && triangles_[shape.mesh].face_count == 0)) return false;
  const Transform& world_from_shape = *shape_poses_[index];
  const Vec3 centre = world_from_origin.inverse_apply(world_from_shape.apply(bounds.centre));
  const double distance_squared = centre[0] * centre[0] + centre[1] * centre[1] + centre[2] * centre[2];
  target.radius = target.tangent_squared = -1.0f;
  if (!is_infinite(shape)) {
    const double radius = bounds.radius;
    if (std::sqrt(distance_squared) - radius > max_range) return false;
    // With a margin for single precision's rounding of the difference of two large squares.
    target.radius = static_cast<float>(radius);
    target.tangent_squared = static_cast<float>(distance_squared - radius * radius - 2e-6 * distance_squared);
  }
  Vec3 eye = world_from_shape.inverse_apply(world_from_origin.position);
  if (shape.kind == ShapeKind::kSphere) eye = {-centre[0], -centre[1], -centre[2]};
  for (int i = 0; i < 3; ++i) {
    const Vec3 axis = world_from_origin.inverse_rotate(world_from_shape.axis(i));
    for (int row = 0; row < 3; ++row) {
      target.axes[3 * i + row] = axis[row];
      target.axes_f32[3 * i + row] = static_cast<float>(axis[row]);
    }
    if (i == bounds.axis) {
      double square = 0.0;
      for (int x = 0; x < 3; ++x) {
        const int y = (x + 1) % 3, z = (x + 2) % 3;
        const double moment = axis[y] * centre[z] - axis[z] * centre[y];
        target.moment[x] = static_cast<float>(moment);
        square += moment * moment;
      }
      const double cylinder_radius = bounds.cylinder_radius + 1e-6 * std::sqrt(distance_squared);
      target.moment_length = static_cast<float>(std::sqrt(square));
      target.cylinder_radius_squared = static_cast<float>(cylinder_radius * cylinder_radius);
    }
    target.size[i] = shape.size[i];
    target.eye[i] = eye[i];
    target.eye_f32[i] = static_cast<float>(eye[i]);
    target.centre[i] = static_cast<float>(centre[i]);
    if (!std::isfinite(target.eye_f32[i]) || !std::isfinite(target.centre[i])) return false;
  }
  target.kind = shape.kind;
  target.index = static_cast<int32_t>(index);
  if (shape.kind == ShapeKind::kMesh) target.bvh = bvhs_[shape.mesh].view();
  return true;
}

void Renderer::cast_rays(const Transform& world_from_origin, const double* directions, size_t count, double max_range,
                         int32_t exclude, double* ranges, int32_t* shapes) {
  if (!(max_range < 1e30)) max_range = 1e30;  // [m] finite in single precision
  if (bvhs_.empty())
    for (const Triangles& mesh : triangles_) bvhs_.push_back(mesh.face_count > 0 ? make_bvh(mesh) : Bvh());
  targets_.clear();
  for (size_t i = 0; i < scene_.shapes.size(); ++i) {
    if (scene_.shapes[i].body == exclude) continue;
    targets_.emplace_back();
    if (!make_target(world_from_origin, i, max_range, targets_.back())) targets_.pop_back();
  }
  candidates_.resize(targets_.size());
  volumes_.resize((targets_.size() + kMaxLanes - 1) / kMaxLanes);
  for (size_t i = 0; i < targets_.size(); ++i) {
    const RayTarget& target = targets_[i];
    BoundingVolumes& volumes = volumes_[i / kMaxLanes];
    const size_t at = i % kMaxLanes;
    for (int axis = 0; axis < 3; ++axis) {
      volumes.centre[axis][at] = target.centre[axis];
      volumes.moment[axis][at] = target.moment[axis];
    }
    volumes.radius[at] = target.radius;
    volumes.cylinder_radius_squared[at] = target.cylinder_radius_squared;
    volumes.moment_length[at] = target.moment_length;
  }
  best_kernel().cast_rays(targets_.data(), volumes_.data(), static_cast<int32_t>(targets_.size()), candidates_.data(),
                          directions, static_cast<int64_t>(count), max_range, ranges, shapes);
}

}  // namespace trundle
