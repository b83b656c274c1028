#include "geometric_shapes/shape_operations.h"

#include <ros/console.h>

#include <cmath>
#include <stdexcept>

#include "geometric_shapes/shape_extents.h"
#include "geometric_shapes/shape_to_marker.h"

namespace shapes {
namespace {

using shape_msgs::SolidPrimitive;

SolidPrimitive primitive(std::uint8_t type, std::initializer_list<std::pair<int, double>> sizes) {
  SolidPrimitive result;
  result.type = type;
  result.dimensions.resize(sizes.size());
  for (const auto& [index, size] : sizes) result.dimensions[static_cast<std::size_t>(index)] = size;
  return result;
}

shape_msgs::Mesh message(const Mesh& mesh) {
  shape_msgs::Mesh result;
  result.vertices.resize(mesh.vertex_count);
  result.triangles.resize(mesh.triangle_count);
  for (std::size_t i = 0; i < mesh.vertex_count; ++i) {
    result.vertices[i].x = mesh.vertices[3 * i];
    result.vertices[i].y = mesh.vertices[3 * i + 1];
    result.vertices[i].z = mesh.vertices[3 * i + 2];
  }
  for (std::size_t i = 0; i < mesh.triangle_count; ++i)
    for (std::size_t k = 0; k < 3; ++k) result.triangles[i].vertex_indices[k] = mesh.triangles[3 * i + k];
  return result;
}

Eigen::AlignedBox3d box(const Mesh& mesh) {
  Eigen::AlignedBox3d result;
  for (std::size_t i = 0; i < mesh.vertex_count; ++i)
    result.extend(Eigen::Vector3d(mesh.vertices[3 * i], mesh.vertices[3 * i + 1], mesh.vertices[3 * i + 2]));
  return result;
}

/** What a marker, or the extents, of each kind of message are. */
struct MarkerOf : boost::static_visitor<void> {
  visualization_msgs::Marker& marker;
  bool use_triangles;

  MarkerOf(visualization_msgs::Marker& target, bool triangles) : marker(target), use_triangles(triangles) {}
  void operator()(const SolidPrimitive& shape) const { geometric_shapes::constructMarkerFromShape(shape, marker); }
  void operator()(const shape_msgs::Mesh& shape) const {
    geometric_shapes::constructMarkerFromShape(shape, marker, use_triangles);
  }
  void operator()(const shape_msgs::Plane&) const {
    throw std::runtime_error("No visual markers can be constructed for planes");
  }
};

struct ExtentsOf : boost::static_visitor<Eigen::Vector3d> {
  template <typename Message>
  Eigen::Vector3d operator()(const Message& shape) const {
    Eigen::Vector3d sides;
    geometric_shapes::getShapeExtents(shape, sides.x(), sides.y(), sides.z());
    return sides;
  }
  Eigen::Vector3d operator()(const shape_msgs::Plane&) const { return Eigen::Vector3d::Zero(); }
};

struct ShapeOf : boost::static_visitor<Shape*> {
  template <typename Message>
  Shape* operator()(const Message& shape) const {
    return constructShapeFromMsg(shape);
  }
};

}  // namespace

Shape* constructShapeFromMsg(const SolidPrimitive& shape_msg) {
  const auto& sizes = shape_msg.dimensions;
  try {
    if (shape_msg.type == SolidPrimitive::SPHERE && !sizes.empty())
      return new Sphere(sizes[SolidPrimitive::SPHERE_RADIUS]);
    if (shape_msg.type == SolidPrimitive::BOX && sizes.size() >= 3)
      return new Box(sizes[SolidPrimitive::BOX_X], sizes[SolidPrimitive::BOX_Y], sizes[SolidPrimitive::BOX_Z]);
    if (shape_msg.type == SolidPrimitive::CYLINDER && sizes.size() >= 2)
      return new Cylinder(sizes[SolidPrimitive::CYLINDER_RADIUS], sizes[SolidPrimitive::CYLINDER_HEIGHT]);
    if (shape_msg.type == SolidPrimitive::CONE && sizes.size() >= 2)
      return new Cone(sizes[SolidPrimitive::CONE_RADIUS], sizes[SolidPrimitive::CONE_HEIGHT]);
    ROS_ERROR("Unable to construct shape corresponding to shape_msg of type %d", static_cast<int>(shape_msg.type));
  } catch (const std::runtime_error& error) {
    ROS_ERROR("%s", error.what());
  }
  return nullptr;
}

Shape* constructShapeFromMsg(const shape_msgs::Plane& shape_msg) {
  return new Plane(shape_msg.coef[0], shape_msg.coef[1], shape_msg.coef[2], shape_msg.coef[3]);
}

Shape* constructShapeFromMsg(const shape_msgs::Mesh& shape_msg) {
  if (shape_msg.triangles.empty() || shape_msg.vertices.empty()) {
    ROS_WARN("Mesh definition is empty");
    return nullptr;
  }
  EigenSTL::vector_Vector3d vertices;
  vertices.reserve(shape_msg.vertices.size());
  for (const auto& vertex : shape_msg.vertices) vertices.emplace_back(vertex.x, vertex.y, vertex.z);
  std::vector<unsigned int> triangles;
  triangles.reserve(3 * shape_msg.triangles.size());
  for (const auto& triangle : shape_msg.triangles)
    triangles.insert(triangles.end(), triangle.vertex_indices.begin(), triangle.vertex_indices.end());
  return createMeshFromVertices(vertices, triangles);
}

Shape* constructShapeFromMsg(const ShapeMsg& shape_msg) { return boost::apply_visitor(ShapeOf(), shape_msg); }

bool constructMsgFromShape(const Shape* shape, ShapeMsg& shape_msg) {
  if (const auto* sphere = dynamic_cast<const Sphere*>(shape)) {
    shape_msg = primitive(SolidPrimitive::SPHERE, {{SolidPrimitive::SPHERE_RADIUS, sphere->radius}});
  } else if (const auto* box = dynamic_cast<const Box*>(shape)) {
    shape_msg = primitive(SolidPrimitive::BOX, {{SolidPrimitive::BOX_X, box->size[0]},
                                                {SolidPrimitive::BOX_Y, box->size[1]},
                                                {SolidPrimitive::BOX_Z, box->size[2]}});
  } else if (const auto* cylinder = dynamic_cast<const Cylinder*>(shape)) {
    shape_msg = primitive(SolidPrimitive::CYLINDER, {{SolidPrimitive::CYLINDER_RADIUS, cylinder->radius},
                                                     {SolidPrimitive::CYLINDER_HEIGHT, cylinder->length}});
  } else if (const auto* cone = dynamic_cast<const Cone*>(shape)) {
    shape_msg = primitive(SolidPrimitive::CONE,
                          {{SolidPrimitive::CONE_RADIUS, cone->radius}, {SolidPrimitive::CONE_HEIGHT, cone->length}});
  } else if (const auto* plane = dynamic_cast<const Plane*>(shape)) {
    shape_msgs::Plane result;
    result.coef = {{plane->a, plane->b, plane->c, plane->d}};
    shape_msg = result;
  } else if (const auto* mesh = dynamic_cast<const Mesh*>(shape)) {
    shape_msg = message(*mesh);
  } else {
    ROS_ERROR("Unable to construct shape message: the shape is %s", shape ? shapeStringName(shape).c_str() : "null");
    return false;
  }
  return true;
}

bool constructMarkerFromShape(const Shape* shape, visualization_msgs::Marker& mk, bool use_mesh_triangle_list) {
  ShapeMsg shape_msg;
  if (!constructMsgFromShape(shape, shape_msg)) return false;
  try {
    boost::apply_visitor(MarkerOf(mk, use_mesh_triangle_list), shape_msg);
    return true;
  } catch (const std::runtime_error& error) {
    ROS_ERROR("%s", error.what());
    return false;
  }
}

Eigen::Vector3d computeShapeExtents(const ShapeMsg& shape_msg) { return boost::apply_visitor(ExtentsOf(), shape_msg); }

Eigen::Vector3d computeShapeExtents(const Shape* shape) {
  ShapeMsg shape_msg;
  if (shape == nullptr || shape->type == OCTREE) return Eigen::Vector3d::Zero();
  if (const auto* mesh = dynamic_cast<const Mesh*>(shape))
    return mesh->vertex_count == 0 ? Eigen::Vector3d(Eigen::Vector3d::Zero()) : Eigen::Vector3d(box(*mesh).sizes());
  return constructMsgFromShape(shape, shape_msg) ? computeShapeExtents(shape_msg) : Eigen::Vector3d::Zero();
}

void computeShapeBoundingSphere(const Shape* shape, Eigen::Vector3d& center, double& radius) {
  center.setZero();
  radius = 0.0;
  if (const auto* sphere = dynamic_cast<const Sphere*>(shape)) {
    radius = sphere->radius;
  } else if (const auto* cuboid = dynamic_cast<const Box*>(shape)) {
    radius = Eigen::Vector3d(cuboid->size).norm() / 2.0;
  } else if (const auto* cylinder = dynamic_cast<const Cylinder*>(shape)) {
    radius = std::hypot(cylinder->radius, cylinder->length / 2.0);
  } else if (const auto* cone = dynamic_cast<const Cone*>(shape)) {
    if (cone->length > cone->radius) {  // through the tip and the rim of the base
      radius = (cone->length + cone->radius * cone->radius / cone->length) / 2.0;
      center.z() = cone->length / 2.0 - radius;
    } else {  // about the base, which is wider than the cone is high
      radius = cone->radius;
      center.z() = -cone->length / 2.0;
    }
  } else if (const auto* mesh = dynamic_cast<const Mesh*>(shape)) {
    if (mesh->vertex_count == 0) return;
    const Eigen::AlignedBox3d bounds = box(*mesh);
    center = bounds.center();
    radius = bounds.diagonal().norm() / 2.0;
  }
}

const std::string& shapeStringName(const Shape* shape) {
  static const std::string none, unknown = "unknown";
  if (shape == nullptr) return none;
  switch (shape->type) {
    case SPHERE: return Sphere::STRING_NAME;
    case CYLINDER: return Cylinder::STRING_NAME;
    case CONE: return Cone::STRING_NAME;
    case BOX: return Box::STRING_NAME;
    case PLANE: return Plane::STRING_NAME;
    case MESH: return Mesh::STRING_NAME;
    case OCTREE: return OcTree::STRING_NAME;
    default: return unknown;
  }
}

}  // namespace shapes
