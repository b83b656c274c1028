// Frames, and where in a picture a shape may be. In double precision: worlds are large, what a camera sees is not.
#pragma once

#include <array>
#include <optional>

#include "kernel.h"

namespace trundle {

using Vec3 = std::array<double, 3>;

// Axes in the columns of `rotation`, row by row.
struct Frame {
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
  Vec3 position{};

  // From x y z qw qx qy qz; the quaternion need not be of unit length. Nothing where a number is not finite.
  static std::optional<Frame> of(const double* pose);
  // With its x along a direction.
  static Frame looking(const Vec3& along, const Vec3& from);
  Frame inverse() const;
  Vec3 axis(int i) const { return {rotation[i], rotation[3 + i], rotation[6 + i]}; }
  // Out of this frame, and back into it.
  Vec3 turn(const Vec3& v) const {
    const auto& r = rotation;
    return {r[0] * v[0] + r[1] * v[1] + r[2] * v[2], r[3] * v[0] + r[4] * v[1] + r[5] * v[2],
            r[6] * v[0] + r[7] * v[1] + r[8] * v[2]};
  }
  Vec3 turn_back(const Vec3& v) const {
    const auto& r = rotation;
    return {r[0] * v[0] + r[3] * v[1] + r[6] * v[2], r[1] * v[0] + r[4] * v[1] + r[7] * v[2],
            r[2] * v[0] + r[5] * v[1] + r[8] * v[2]};
  }
  Vec3 move(const Vec3& p) const {
    const Vec3 turned = turn(p);
    return {turned[0] + position[0], turned[1] + position[1], turned[2] + position[2]};
  }
  Vec3 move_back(const Vec3& p) const {
    return turn_back({p[0] - position[0], p[1] - position[1], p[2] - position[2]});
  }
};

// world_from_a @ a_from_b
Frame operator*(const Frame& world_from_a, const Frame& a_from_b);

struct Rectangle {
  int32_t left, top, right, bottom;  // the last ones excluded
  double ahead;  // [m] how far along the view axis the nearest corner is
  bool empty() const { return left >= right || top >= bottom; }
};

// The pixels that a box, given in the camera's frame, may cover.
Rectangle covered(const View& view, const Frame& camera_from_box, const Vec3& low, const Vec3& high);

}  // namespace trundle
