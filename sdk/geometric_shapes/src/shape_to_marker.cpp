#include "geometric_shapes/shape_to_marker.h"

#include <initializer_list>
#include <stdexcept>
#include <string>

namespace geometric_shapes {
namespace {

using shape_msgs::SolidPrimitive;
using visualization_msgs::Marker;

constexpr double kLineWidth = 0.01;  // [m]

void require(const SolidPrimitive& shape, std::size_t count, const char* name) {
  if (shape.dimensions.size() < count)
    throw std::runtime_error(std::string("Insufficient dimensions in ") + name + " definition");
}

void setScale(Marker& marker, double x, double y, double z) {
  marker.scale.x = x;
  marker.scale.y = y;
  marker.scale.z = z;
}

}  // namespace

void constructMarkerFromShape(const shape_msgs::Mesh& shape_msg, Marker& marker, bool use_mesh_triangle_list) {
  if (shape_msg.triangles.empty() || shape_msg.vertices.empty()) throw std::runtime_error("Mesh definition is empty");
  for (const auto& triangle : shape_msg.triangles)
    for (const unsigned int corner : triangle.vertex_indices)
      if (corner >= shape_msg.vertices.size()) throw std::runtime_error("A triangle names a vertex that is not there");
  const auto add = [&](const shape_msgs::MeshTriangle& triangle, std::initializer_list<int> corners) {
    for (const int k : corners) marker.points.push_back(shape_msg.vertices[triangle.vertex_indices[k]]);
  };
  marker.type = Marker::LINE_LIST;
  if (use_mesh_triangle_list) marker.type = Marker::TRIANGLE_LIST;
  const double scale = use_mesh_triangle_list ? 1.0 : kLineWidth;
  setScale(marker, scale, scale, scale);
  for (const auto& triangle : shape_msg.triangles)
    if (use_mesh_triangle_list) add(triangle, {0, 1, 2});
    else add(triangle, {0, 1, 1, 2, 2, 0});
}

void constructMarkerFromShape(const SolidPrimitive& shape_msg, Marker& marker) {
  const auto& sizes = shape_msg.dimensions;
  switch (shape_msg.type) {
    case SolidPrimitive::SPHERE: {
      require(shape_msg, 1, "sphere");
      const double diameter = 2.0 * sizes[SolidPrimitive::SPHERE_RADIUS];
      marker.type = Marker::SPHERE;
      setScale(marker, diameter, diameter, diameter);
      break;
    }
    case SolidPrimitive::BOX:
      require(shape_msg, 3, "box");
      marker.type = Marker::CUBE;
      setScale(marker, sizes[SolidPrimitive::BOX_X], sizes[SolidPrimitive::BOX_Y], sizes[SolidPrimitive::BOX_Z]);
      break;
    case SolidPrimitive::CYLINDER: {
      require(shape_msg, 2, "cylinder");
      const double diameter = 2.0 * sizes[SolidPrimitive::CYLINDER_RADIUS];
      marker.type = Marker::CYLINDER;
      setScale(marker, diameter, diameter, sizes[SolidPrimitive::CYLINDER_HEIGHT]);
      break;
    }
    case SolidPrimitive::CONE: {  // markers have no cones
      require(shape_msg, 2, "cone");
      const double diameter = 2.0 * sizes[SolidPrimitive::CONE_RADIUS];
      marker.type = Marker::CYLINDER;
      setScale(marker, diameter, diameter, sizes[SolidPrimitive::CONE_HEIGHT]);
      break;
    }
    default: throw std::runtime_error("Unknown shape type: " + std::to_string(shape_msg.type));
  }
}

}  // namespace geometric_shapes
