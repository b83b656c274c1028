// Rigid transforms and screen bounds, in double precision: worlds are large, camera frames are not.
#pragma once

#include <array>
#include <optional>

#include "kernel.h"

namespace trundle {

using Vec3 = std::array<double, 3>;

// a_from_b: `rotation` is row-major, its columns are b's axes in a.
struct Transform {
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
  Vec3 position{};

  // pose: x y z qw qx qy qz, the quaternion of any length > 0. Nothing if a number is not finite.
  static std::optional<Transform> from_pose(const double* pose);
  // x axis along a direction.
  static Transform look_along(const Vec3& along, const Vec3& from);
  Transform inverse() const;
  Vec3 axis(int i) const { return {rotation[i], rotation[3 + i], rotation[6 + i]}; }
  Vec3 rotate(const Vec3& v) const {
    const auto& r = rotation;
    return {r[0] * v[0] + r[1] * v[1] + r[2] * v[2], r[3] * v[0] + r[4] * v[1] + r[5] * v[2],
            r[6] * v[0] + r[7] * v[1] + r[8] * v[2]};
  }
  Vec3 inverse_rotate(const Vec3& v) const {
    const auto& r = rotation;
    return {r[0] * v[0] + r[3] * v[1] + r[6] * v[2], r[1] * v[0] + r[4] * v[1] + r[7] * v[2],
            r[2] * v[0] + r[5] * v[1] + r[8] * v[2]};
  }
  Vec3 apply(const Vec3& p) const {
    const Vec3 turned = rotate(p);
    return {turned[0] + position[0], turned[1] + position[1], turned[2] + position[2]};
  }
  Vec3 inverse_apply(const Vec3& p) const {
    return inverse_rotate({p[0] - position[0], p[1] - position[1], p[2] - position[2]});
  }
};

// world_from_a @ a_from_b
Transform operator*(const Transform& world_from_a, const Transform& a_from_b);

struct Rectangle {
  int32_t left, top, right, bottom;  // right and bottom excluded
  double min_depth;                  // [m] of the nearest corner along the view axis
  bool empty() const { return left >= right || top >= bottom; }
};

// Pixels that a box may cover.
Rectangle screen_bounds(const View& view, const Transform& camera_from_box, const Vec3& low, const Vec3& high);

}  // namespace trundle
