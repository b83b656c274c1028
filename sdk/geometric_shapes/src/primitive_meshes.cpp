// Meshes of spheres, boxes, cylinders and cones.
#include <ros/console.h>

#include <algorithm>
#include <cmath>

#include "geometric_shapes/shape_operations.h"

namespace shapes {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kSide = 0.01;                // [m], of a sphere's triangles
constexpr double kSegmentsPerRadius = 100.0;  // [1/m], of cylinders and cones
constexpr double kLeastSegments = 6.0, kMostSegments = 1000.0;

/** Number of parts of a circle, which a very large one has not more of. */
unsigned int segments(double wanted) {
  return static_cast<unsigned int>(std::min(std::max(std::ceil(wanted), kLeastSegments), kMostSegments));
}

/** Mesh of a profile (distance to z, z) that turns about z; it starts above and ends below, both on the axis. */
Mesh* revolved(const EigenSTL::vector_Vector2d& profile, unsigned int count) {
  EigenSTL::vector_Vector3d vertices{{0.0, 0.0, profile.front().y()}, {0.0, 0.0, profile.back().y()}};
  for (std::size_t ring = 1; ring + 1 < profile.size(); ++ring)
    for (unsigned int j = 0; j < count; ++j) {
      const double angle = 2.0 * kPi * j / count;
      vertices.emplace_back(profile[ring].x() * std::cos(angle), profile[ring].x() * std::sin(angle),
                            profile[ring].y());
    }
  const unsigned int rings = static_cast<unsigned int>(profile.size()) - 2;
  const auto at = [&](unsigned int ring, unsigned int j) { return 2 + ring * count + j % count; };
  std::vector<unsigned int> triangles;
  for (unsigned int j = 0; j < count; ++j) {
    triangles.insert(triangles.end(), {0, at(0, j), at(0, j + 1)});
    for (unsigned int ring = 0; ring + 1 < rings; ++ring)
      triangles.insert(triangles.end(), {at(ring, j), at(ring + 1, j), at(ring, j + 1), at(ring, j + 1),
                                         at(ring + 1, j), at(ring + 1, j + 1)});
    triangles.insert(triangles.end(), {1, at(rings - 1, j + 1), at(rings - 1, j)});
  }
  return createMeshFromVertices(vertices, triangles);
}

}  // namespace

Mesh* createMeshFromShape(const Shape* shape) {
  if (const auto* sphere = dynamic_cast<const Sphere*>(shape)) return createMeshFromShape(*sphere);
  if (const auto* box = dynamic_cast<const Box*>(shape)) return createMeshFromShape(*box);
  if (const auto* cylinder = dynamic_cast<const Cylinder*>(shape)) return createMeshFromShape(*cylinder);
  if (const auto* cone = dynamic_cast<const Cone*>(shape)) return createMeshFromShape(*cone);
  ROS_ERROR("Conversion of shape of type '%s' to a mesh is not known", shapeStringName(shape).c_str());
  return nullptr;
}

Mesh* createMeshFromShape(const Box& box) {
  EigenSTL::vector_Vector3d vertices;  // number: bit k for the far side along axis k
  for (unsigned int i = 0; i < 8; ++i)
    vertices.emplace_back(((i & 1) ? 0.5 : -0.5) * box.size[0], ((i & 2) ? 0.5 : -0.5) * box.size[1],
                          ((i & 4) ? 0.5 : -0.5) * box.size[2]);
  std::vector<unsigned int> triangles;
  for (unsigned int axis = 0; axis < 3; ++axis) {
    const unsigned int far = 1u << axis, u = 1u << (axis + 1) % 3, v = 1u << (axis + 2) % 3;
    triangles.insert(triangles.end(), {far, far | u, far | u | v, far, far | u | v, far | v});
    triangles.insert(triangles.end(), {0, u | v, u, 0, v, u | v});
  }
  return createMeshFromVertices(vertices, triangles);
}

Mesh* createMeshFromShape(const Sphere& sphere) {
  const unsigned int count = segments(2.0 * kPi * sphere.radius / kSide), rings = segments(2.0 * sphere.radius / kSide);
  EigenSTL::vector_Vector2d profile{{0.0, sphere.radius}};
  for (unsigned int i = 1; i <= rings; ++i) {
    const double angle = kPi * i / (rings + 1);
    profile.emplace_back(sphere.radius * std::sin(angle), sphere.radius * std::cos(angle));
  }
  profile.emplace_back(0.0, -sphere.radius);
  return revolved(profile, count);
}

Mesh* createMeshFromShape(const Cylinder& cylinder) {
  const double r = cylinder.radius, half = cylinder.length / 2.0;
  return revolved({{0.0, half}, {r, half}, {r, -half}, {0.0, -half}}, segments(kSegmentsPerRadius * r));
}

Mesh* createMeshFromShape(const Cone& cone) {
  const double r = cone.radius, half = cone.length / 2.0;
  return revolved({{0.0, half}, {r, -half}, {0.0, -half}}, segments(kSegmentsPerRadius * r));
}

}  // namespace shapes
