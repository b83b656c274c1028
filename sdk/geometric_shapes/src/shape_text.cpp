// Shapes as text: the name of the type, and numbers.
#include <ros/console.h>

#include <stdexcept>

#include "geometric_shapes/shape_operations.h"

namespace shapes {
namespace {

/** The next numbers of a text; throws where there are less. */
template <std::size_t count>
std::array<double, count> numbers(std::istream& in) {
  std::array<double, count> values;
  for (double& value : values)
    if (!(in >> value)) throw std::runtime_error("a number of the shape is missing");
  return values;
}

/** Memory grows as numbers come: the counts before them are only believed in the end. */
Mesh* readMesh(std::istream& in) {
  unsigned int vertex_count = 0, triangle_count = 0;
  if (!(in >> vertex_count >> triangle_count)) throw std::runtime_error("the counts of the mesh are missing");
  EigenSTL::vector_Vector3d vertices;
  for (unsigned int i = 0; i < vertex_count; ++i) {
    const auto [x, y, z] = numbers<3>(in);
    vertices.emplace_back(x, y, z);
  }
  std::vector<unsigned int> triangles;
  for (std::size_t i = 0; i < std::size_t{3} * triangle_count; ++i) {
    unsigned int corner = 0;
    if (!(in >> corner)) throw std::runtime_error("a triangle of the mesh is missing");
    triangles.push_back(corner);
  }
  return createMeshFromVertices(vertices, triangles);
}

}  // namespace

void saveAsText(const Shape* shape, std::ostream& out) {
  if (shape == nullptr || shape->type == OCTREE || shape->type == UNKNOWN_SHAPE) {
    ROS_ERROR("Unable to save shape: it is %s", shape ? shapeStringName(shape).c_str() : "null");
    return;
  }
  out << shapeStringName(shape) << '\n';
  if (const auto* sphere = dynamic_cast<const Sphere*>(shape)) {
    out << sphere->radius << '\n';
  } else if (const auto* box = dynamic_cast<const Box*>(shape)) {
    out << box->size[0] << ' ' << box->size[1] << ' ' << box->size[2] << '\n';
  } else if (const auto* cylinder = dynamic_cast<const Cylinder*>(shape)) {
    out << cylinder->radius << ' ' << cylinder->length << '\n';
  } else if (const auto* cone = dynamic_cast<const Cone*>(shape)) {
    out << cone->radius << ' ' << cone->length << '\n';
  } else if (const auto* plane = dynamic_cast<const Plane*>(shape)) {
    out << plane->a << ' ' << plane->b << ' ' << plane->c << ' ' << plane->d << '\n';
  } else if (const auto* mesh = dynamic_cast<const Mesh*>(shape)) {
    const auto write = [&](const auto* values, unsigned int count) {
      for (std::size_t i = 0; i < count; ++i)
        out << values[3 * i] << ' ' << values[3 * i + 1] << ' ' << values[3 * i + 2] << '\n';
    };
    out << mesh->vertex_count << ' ' << mesh->triangle_count << '\n';
    write(mesh->vertices, mesh->vertex_count);
    write(mesh->triangles, mesh->triangle_count);
  }
  out.flush();
}

Shape* constructShapeFromText(std::istream& in) {
  std::string type;
  if (!(in >> type)) return nullptr;
  try {
    if (type == Sphere::STRING_NAME) return new Sphere(numbers<1>(in)[0]);
    if (type == Box::STRING_NAME) {
      const auto [x, y, z] = numbers<3>(in);
      return new Box(x, y, z);
    }
    if (type == Cylinder::STRING_NAME || type == Cone::STRING_NAME) {
      const auto [radius, length] = numbers<2>(in);
      if (type == Cone::STRING_NAME) return new Cone(radius, length);
      return new Cylinder(radius, length);
    }
    if (type == Plane::STRING_NAME) {
      const auto [a, b, c, d] = numbers<4>(in);
      return new Plane(a, b, c, d);
    }
    if (type == Mesh::STRING_NAME) return readMesh(in);
    throw std::runtime_error("the type is unknown");
  } catch (const std::runtime_error& error) {
    ROS_ERROR("Unable to read shape of type '%s': %s", type.c_str(), error.what());
    return nullptr;
  }
}

}  // namespace shapes
