#include "convex_shape.h"

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <utility>

namespace trundle::planning {

namespace {

std::atomic<std::uint64_t> next_id = 1;

Vec3 highest_corner(const std::vector<float>& corners, const Vec3& direction) {
  const auto x = static_cast<float>(direction.x), y = static_cast<float>(direction.y),
             z = static_cast<float>(direction.z);
  std::size_t best = 0;
  float highest = -1e30F;
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const float height = x * corners[i] + y * corners[i + 1] + z * corners[i + 2];
    if (height > highest) {
      highest = height;
      best = i;
    }
  }
  return {corners[best], corners[best + 1], corners[best + 2]};
}

}  // namespace

Vec3 ConvexShape::support(const Vec3& direction) const {
  switch (kind) {
    case ShapeKind::kBox:
      return {std::copysign(size[0], direction.x), std::copysign(size[1], direction.y),
              std::copysign(size[2], direction.z)};
    case ShapeKind::kSphere: {
      const double length = norm(direction);
      return length > 0.0 ? (size[0] / length) * direction : Vec3{};
    }
    case ShapeKind::kCylinder: {
      const double length = std::hypot(direction.x, direction.y);
      const double factor = length > 0.0 ? size[0] / length : 0.0;
      return {factor * direction.x, factor * direction.y, std::copysign(size[1], direction.z)};
    }
    default: return center + highest_corner(corners, direction);
  }
}

ConvexShape make_primitive(ShapeKind kind, std::array<double, 3> size) {
  ConvexShape shape;
  shape.kind = kind;
  shape.size = size;
  if (kind == ShapeKind::kBox) shape.half = {size[0], size[1], size[2]};
  else if (kind == ShapeKind::kSphere) shape.half = {size[0], size[0], size[0]};
  else if (kind == ShapeKind::kCylinder) shape.half = {size[0], size[0], size[1]};
  else shape.half = {1e6, 1e6, 1e6};  // a plane
  shape.radius = kind == ShapeKind::kSphere ? size[0] : norm(shape.half);
  return shape;
}

ConvexShape make_hull(const std::vector<double>& corners) {
  if (corners.size() < 3) throw std::invalid_argument("a hull needs a corner");
  ConvexShape shape;
  shape.kind = ShapeKind::kHull;
  shape.id = next_id.fetch_add(1);
  std::array<double, 3> low{1e30, 1e30, 1e30}, high{-1e30, -1e30, -1e30};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    low[i % 3] = std::min(low[i % 3], corners[i]);
    high[i % 3] = std::max(high[i % 3], corners[i]);
  }
  shape.center = {0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), 0.5 * (low[2] + high[2])};
  shape.half = {0.5 * (high[0] - low[0]), 0.5 * (high[1] - low[1]), 0.5 * (high[2] - low[2])};
  shape.corners.resize(corners.size());
  for (std::size_t i = 0; i < corners.size(); i += 3) {
    const Vec3 corner = Vec3{corners[i], corners[i + 1], corners[i + 2]} - shape.center;
    shape.radius = std::max(shape.radius, norm(corner));
    for (int k = 0; k < 3; ++k) shape.corners[i + static_cast<std::size_t>(k)] = static_cast<float>(corner[k]);
  }
  return shape;
}

}  // namespace trundle::planning
