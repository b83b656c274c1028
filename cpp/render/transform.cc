#include "transform.h"

#include <algorithm>
#include <cmath>

namespace trundle {

std::optional<Transform> Transform::from_pose(const double* pose) {
  double square = 0.0;
  for (int i = 0; i < 7; ++i)
    if (!std::isfinite(pose[i])) return std::nullopt;
  for (int i = 3; i < 7; ++i) square += pose[i] * pose[i];
  if (!(square > 0.0) || !std::isfinite(square)) return std::nullopt;
  const double length = std::sqrt(square);
  const double w = pose[3] / length, x = pose[4] / length, y = pose[5] / length, z = pose[6] / length;
  return Transform{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),  //
                    2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),  //
                    2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)},
                   {pose[0], pose[1], pose[2]}};
}

Transform Transform::look_along(const Vec3& along, const Vec3& from) {
  const double length = std::sqrt(along[0] * along[0] + along[1] * along[1] + along[2] * along[2]);
  const Vec3 x = {along[0] / length, along[1] / length, along[2] / length};
  const double across = std::hypot(x[0], x[1]);
  const Vec3 y = across > 1e-6 ? Vec3{-x[1] / across, x[0] / across, 0.0} : Vec3{0.0, 1.0, 0.0};
  const Vec3 z = {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
  return {{x[0], y[0], z[0], x[1], y[1], z[1], x[2], y[2], z[2]}, from};
}

Transform Transform::inverse() const {
  const auto& r = rotation;
  const Transform turned{{r[0], r[3], r[6], r[1], r[4], r[7], r[2], r[5], r[8]}, {}};
  const Vec3 moved = turned.rotate(position);
  return {turned.rotation, {-moved[0], -moved[1], -moved[2]}};
}

Transform operator*(const Transform& world_from_a, const Transform& a_from_b) {
  Transform product;
  for (int i = 0; i < 3; ++i) {
    const Vec3 column = world_from_a.rotate(a_from_b.axis(i));
    for (int row = 0; row < 3; ++row) product.rotation[3 * row + i] = column[row];
  }
  product.position = world_from_a.apply(a_from_b.position);
  return product;
}

Rectangle screen_bounds(const View& view, const Transform& camera_from_box, const Vec3& low, const Vec3& high) {
  std::array<Vec3, 8> corners;
  for (int i = 0; i < 8; ++i)
    corners[i] = camera_from_box.apply({i & 1 ? high[0] : low[0], i & 2 ? high[1] : low[1], i & 4 ? high[2] : low[2]});
  double min_depth = INFINITY;
  for (const Vec3& corner : corners) min_depth = std::min(min_depth, corner[0]);
  double left = INFINITY, right = -INFINITY, top = INFINITY, bottom = -INFINITY;
  const auto extend = [&](double x, double y, double z) {
    const double scale = view.orthographic ? view.focal : view.focal / x;
    const double u = view.centre_u - scale * y, v = view.centre_v - scale * z;
    left = std::min(left, u);
    right = std::max(right, u);
    top = std::min(top, v);
    bottom = std::max(bottom, v);
  };
  const double near_ = view.near_ * (1.0 - 1e-6);  // points on the plane itself are visible
  for (int i = 0; i < 8; ++i) {
    const Vec3& a = corners[i];
    if (a[0] >= near_ || view.orthographic) extend(a[0], a[1], a[2]);
    if (view.orthographic) continue;
    for (const int bit : {1, 2, 4}) {
      const Vec3& b = corners[i ^ bit];
      if (!(a[0] >= near_) || b[0] >= near_) continue;
      const double share = (near_ - a[0]) / (b[0] - a[0]);
      extend(near_, a[1] + share * (b[1] - a[1]), a[2] + share * (b[2] - a[2]));
    }
  }
  // One pixel more on each side for single precision's rounding. NaN covers the whole image.
  const auto pixel = [](double at, int32_t last, int32_t otherwise) {
    return std::isnan(at) ? otherwise
                          : static_cast<int32_t>(std::clamp(std::floor(at), 0.0, static_cast<double>(last)));
  };
  if (left > right) return {0, 0, 0, 0, min_depth};
  return {pixel(left - 1.0, view.width, 0), pixel(top - 1.0, view.height, 0),
          pixel(right + 2.0, view.width, view.width), pixel(bottom + 2.0, view.height, view.height), min_depth};
}

}  // namespace trundle
