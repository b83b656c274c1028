// Convex shapes that collide: primitives, hulls of points, triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "rigid.h"

namespace trundle::planning {

enum class ShapeKind { kPlane = 0, kSphere = 2, kCylinder = 5, kBox = 6, kHull = 7 };  // numbers of MuJoCo's mjtGeom

struct ConvexShape {
  ShapeKind kind = ShapeKind::kBox;
  std::array<double, 3> size{};  // box: half lengths; cylinder: radius, half length; sphere: radius [m]
  std::vector<float> corners;    // hull: x, y, z of each corner from `center` [m]
  Vec3 center, half;             // box around it, in its frame
  double radius = 0.0;           // of the sphere around that box
  std::uint64_t id = 0;          // of its corners, for what caches them

  // Corner or surface point farthest along a direction, in the shape's frame; not for planes.
  Vec3 support(const Vec3& direction) const;
};

// Shape with its bounds; sizes as in ConvexShape::size.
ConvexShape make_primitive(ShapeKind kind, std::array<double, 3> size);
// Hull of at least one corner.
ConvexShape make_hull(const std::vector<double>& corners);

}  // namespace trundle::planning
