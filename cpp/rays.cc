// Rays from one place into a scene.
#include <cmath>

#include "renderer.h"

namespace trundle {

// How a shape is met by rays from somewhere; false where none can come near it.
bool Renderer::aim(const Frame& world_from_place, size_t index, double reach, Target& target) const {
  const ShapeSpec& shape = scene_.shapes[index];
  const Bounds& bounds = bounds_[index];
  if (!shape_poses_[index] || (shape.kind == Kind::kMesh && triangles_[shape.mesh].face_count == 0)) return false;
  const Frame& world_from_shape = *shape_poses_[index];
  const Vec3 middle = world_from_place.move_back(world_from_shape.move(bounds.middle));
  const double away = middle[0] * middle[0] + middle[1] * middle[1] + middle[2] * middle[2];
  target.radius = target.reach = -1.0f;
  if (!is_endless(shape)) {
    const double radius = bounds.radius;
    if (std::sqrt(away) - radius > reach) return false;
    // What single precision loses in the difference of two large squares is added.
    target.radius = (float)radius, target.reach = (float)(away - radius * radius - 2e-6 * away);
  }
  Vec3 eye = world_from_shape.move_back(world_from_place.position);
  if (shape.kind == Kind::kSphere) eye = {-middle[0], -middle[1], -middle[2]};
  for (int i = 0; i < 3; ++i) {
    const Vec3 axis = world_from_place.turn_back(world_from_shape.axis(i));
    for (int row = 0; row < 3; ++row) {
      target.axes[3 * i + row] = axis[row];
      target.narrow_axes[3 * i + row] = (float)axis[row];
    }
    if (i == bounds.axis) {
      double square = 0.0;
      for (int x = 0; x < 3; ++x) {
        const int y = (x + 1) % 3, z = (x + 2) % 3;
        const double aside = axis[y] * middle[z] - axis[z] * middle[y];
        target.aside[x] = (float)aside, square += aside * aside;
      }
      const double thickness = bounds.thickness + 1e-6 * std::sqrt(away);
      target.aside_length = (float)std::sqrt(square), target.thickness = (float)(thickness * thickness);
    }
    target.size[i] = shape.size[i];
    target.eye[i] = eye[i], target.narrow_eye[i] = (float)eye[i], target.middle[i] = (float)middle[i];
    if (!std::isfinite(target.narrow_eye[i]) || !std::isfinite(target.middle[i])) return false;
  }
  target.kind = shape.kind;
  target.index = (int32_t)index;
  if (shape.kind == Kind::kMesh) target.bvh = trees_[shape.mesh].view();
  return true;
}

void Renderer::cast(const Frame& world_from_place, const double* directions, size_t count, double reach,
                    int32_t exclude, double* ranges, int32_t* shapes) {
  if (!(reach < 1e30)) reach = 1e30;  // [m] a single-precision number
  if (trees_.empty())
    for (const Triangles& mesh : triangles_) trees_.push_back(mesh.face_count > 0 ? make_bvh(mesh) : Bvh());
  targets_.clear();
  for (size_t i = 0; i < scene_.shapes.size(); ++i) {
    if (scene_.shapes[i].body == exclude) continue;
    targets_.emplace_back();
    if (!aim(world_from_place, i, reach, targets_.back())) targets_.pop_back();
  }
  near_.resize(targets_.size()), around_.resize((targets_.size() + kWidest - 1) / kWidest);
  for (size_t i = 0; i < targets_.size(); ++i) {
    const Target& target = targets_[i];
    Around& around = around_[i / kWidest];
    const size_t at = i % kWidest;
    for (int axis = 0; axis < 3; ++axis)
      around.middle[axis][at] = target.middle[axis], around.aside[axis][at] = target.aside[axis];
    around.radius[at] = target.radius, around.thickness[at] = target.thickness;
    around.aside_length[at] = target.aside_length;
  }
  best_kernel().cast(targets_.data(), around_.data(), (int32_t)targets_.size(), near_.data(), directions, (int64_t)count,
                     reach, ranges, shapes);
}

}  // namespace trundle
