// Shapes, their messages, markers, extents, texts and meshes; prints a line for each check that fails.
#include <geometric_shapes/check_isometry.h>
#include <geometric_shapes/shape_extents.h>
#include <geometric_shapes/shape_operations.h>
#include <geometric_shapes/shape_to_marker.h>
#include <geometric_shapes/solid_primitive_dims.h>

#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <sstream>

namespace {

int made = 0, failed = 0;
#define CHECK(cond)                                                        \
  do {                                                                     \
    ++made;                                                                \
    if (!(cond)) {                                                         \
      ++failed;                                                            \
      std::cout << "failed, line " << __LINE__ << ": " #cond << std::endl; \
    }                                                                      \
  } while (false)

using MeshPtr = std::unique_ptr<shapes::Mesh>;

bool isNear(double one, double other, double tolerance = 1e-9) { return std::fabs(one - other) <= tolerance; }

template <typename Function>
bool throws(Function function) {
  try {
    function();
  } catch (const std::runtime_error&) {
    return true;
  }
  return false;
}

Eigen::Vector3d vertex(const shapes::Mesh& mesh, unsigned int i) { return Eigen::Map<const Eigen::Vector3d>(mesh.vertices + 3 * i); }

/** Of a closed surface whose triangles face outwards. */
double volume(const shapes::Mesh& mesh) {
  double sum = 0.0;
  for (unsigned int i = 0; i < mesh.triangle_count; ++i) {
    const unsigned int* corner = mesh.triangles + 3 * i;
    sum += vertex(mesh, corner[0]).dot(vertex(mesh, corner[1]).cross(vertex(mesh, corner[2]))) / 6.0;
  }
  return sum;
}

std::string text(const shapes::Shape& shape) {
  std::ostringstream out;
  shapes::saveAsText(&shape, out);
  return out.str();
}

void checkSizes() {
  shapes::Sphere sphere(1.0);
  sphere.scaleAndPadd(2.0, 0.5);
  CHECK(isNear(sphere.radius, 2.5) && sphere.type == shapes::SPHERE && !sphere.isFixed());
  shapes::Cylinder cylinder(1.0, 2.0);
  cylinder.scale(2.0, 3.0);
  cylinder.padd(0.5);
  CHECK(isNear(cylinder.radius, 2.5) && isNear(cylinder.length, 7.0));
  shapes::Cone cone(1.0, 2.0);
  cone.scaleAndPadd(1.0, 1.0, 0.1, 0.2);
  CHECK(isNear(cone.radius, 1.1) && isNear(cone.length, 2.4));
  shapes::Box box(1.0, 2.0, 3.0);
  box.scaleAndPadd(2.0, 1.0, 1.0, 0.0, 0.5, 0.0);
  CHECK(isNear(box.size[0], 2.0) && isNear(box.size[1], 3.0) && isNear(box.size[2], 3.0));
  CHECK(throws([&] { box.padd(-2.0); }) && isNear(box.size[0], 2.0));  // as it was
  CHECK(throws([] { shapes::Sphere(-1.0); }) && throws([] { shapes::Cone(1.0, -1.0); }));
  shapes::Plane plane(0.0, 0.0, 1.0, 0.5);
  plane.scale(3.0);
  CHECK(plane.isFixed() && plane.d == 0.5);
  shapes::OcTree tree;
  tree.padd(1.0);
  CHECK(tree.isFixed() && !tree.octree);
  const shapes::ShapePtr copy(static_cast<const shapes::Shape&>(box).clone());
  const shapes::ShapeConstPtr constant = copy;
  CHECK(constant->type == shapes::BOX && isNear(static_cast<shapes::Box&>(*copy).size[1], 3.0));
  std::ostringstream out;
  cylinder.print(out);
  out << shapes::CONE << shapes::Mesh::STRING_NAME;
  CHECK(out.str() == "Cylinder[radius=2.5, length=7]\nconemesh");
}

void checkMessages() {
  shapes::ShapeMsg message;
  const shapes::Cylinder cylinder(0.1, 0.4);
  CHECK(shapes::constructMsgFromShape(&cylinder, message));
  const auto& primitive = boost::get<shape_msgs::SolidPrimitive>(message);
  CHECK(primitive.type == shape_msgs::SolidPrimitive::CYLINDER && primitive.dimensions[shape_msgs::SolidPrimitive::CYLINDER_HEIGHT] == 0.4);
  const std::unique_ptr<shapes::Shape> back(shapes::constructShapeFromMsg(message));
  CHECK(back && back->type == shapes::CYLINDER && static_cast<shapes::Cylinder&>(*back).radius == 0.1);
  CHECK(shapes::computeShapeExtents(message).isApprox(Eigen::Vector3d(0.2, 0.2, 0.4)));

  const shapes::Plane plane(0.0, 0.0, 1.0, -0.3);
  visualization_msgs::Marker marker;
  CHECK(shapes::constructMsgFromShape(&plane, message) && boost::get<shape_msgs::Plane>(message).coef[3] == -0.3);
  CHECK(shapes::computeShapeExtents(message).isZero() && !shapes::constructMarkerFromShape(&plane, marker));
  CHECK(!shapes::constructMsgFromShape(nullptr, message));

  const shapes::Cone cone(0.5, 2.0);
  CHECK(shapes::constructMarkerFromShape(&cone, marker) && marker.type == visualization_msgs::Marker::CYLINDER);
  CHECK(marker.scale.x == 1.0 && marker.scale.z == 2.0);
  const MeshPtr box(shapes::createMeshFromShape(shapes::Box(1.0, 1.0, 1.0)));
  CHECK(shapes::constructMarkerFromShape(box.get(), marker, true) && marker.points.size() == 36);
  visualization_msgs::Marker lines;
  CHECK(shapes::constructMarkerFromShape(box.get(), lines) && lines.points.size() == 72);
  CHECK(lines.type == visualization_msgs::Marker::LINE_LIST && lines.scale.x == 0.01);

  shape_msgs::SolidPrimitive wrong;
  wrong.type = shape_msgs::SolidPrimitive::BOX;
  wrong.dimensions.resize(2);
  CHECK(shapes::constructShapeFromMsg(wrong) == nullptr);
  CHECK(throws([&] { geometric_shapes::constructMarkerFromShape(wrong, marker); }));
  wrong.dimensions.assign({1.0, 1.0, -1.0});
  CHECK(shapes::constructShapeFromMsg(wrong) == nullptr);
  shape_msgs::Mesh mesh;
  CHECK(shapes::constructShapeFromMsg(mesh) == nullptr);
  mesh.vertices.resize(3);
  mesh.triangles.resize(1);
  mesh.triangles[0].vertex_indices = {{0, 1, 3}};
  CHECK(shapes::constructShapeFromMsg(mesh) == nullptr);
  CHECK(throws([&] { geometric_shapes::constructMarkerFromShape(mesh, marker); }));
  CHECK(geometric_shapes::solidPrimitiveDimCount<shape_msgs::SolidPrimitive::BOX>() == 3);
  CHECK(geometric_shapes::SolidPrimitiveDimCount<shape_msgs::SolidPrimitive::CONE>::value == 2);
}

void checkSpheres() {
  Eigen::Vector3d center;
  double radius = 0.0;
  const shapes::Box box(2.0, 3.0, 6.0);
  shapes::computeShapeBoundingSphere(&box, center, radius);
  CHECK(isNear(radius, 3.5) && center.isZero());
  const shapes::Cone high(3.0, 9.0), flat(2.0, 1.0);
  shapes::computeShapeBoundingSphere(&high, center, radius);
  CHECK(isNear(radius, 5.0) && isNear(center.z(), -0.5));  // 4.5 - 5; the rim is 4 below and 3 beside
  shapes::computeShapeBoundingSphere(&flat, center, radius);
  CHECK(isNear(radius, 2.0) && isNear(center.z(), -0.5));
  const MeshPtr mesh(shapes::createMeshFromShape(box));
  shapes::computeShapeBoundingSphere(mesh.get(), center, radius);
  CHECK(isNear(radius, 3.5) && center.isZero(1e-12));
  CHECK(shapes::computeShapeExtents(mesh.get()).isApprox(Eigen::Vector3d(2.0, 3.0, 6.0)));
}

void checkMeshes() {
  const MeshPtr box(shapes::createMeshFromShape(shapes::Box(1.0, 2.0, 3.0)));
  CHECK(box->vertex_count == 8 && box->triangle_count == 12 && isNear(volume(*box), 6.0));
  const MeshPtr sphere(shapes::createMeshFromShape(shapes::Sphere(0.5)));
  CHECK(isNear(volume(*sphere), 4.0 / 3.0 * M_PI * 0.125, 2e-3));
  const MeshPtr cylinder(shapes::createMeshFromShape(shapes::Cylinder(0.5, 2.0)));
  CHECK(isNear(volume(*cylinder), M_PI * 0.25 * 2.0, 1e-2));
  const MeshPtr cone(shapes::createMeshFromShape(shapes::Cone(0.5, 2.0)));
  CHECK(isNear(volume(*cone), M_PI * 0.25 * 2.0 / 3.0, 1e-2) && isNear(shapes::computeShapeExtents(cone.get()).z(), 2.0));
  const MeshPtr world(shapes::createMeshFromShape(shapes::Sphere(1e6)));
  CHECK(world->vertex_count <= 1000002);  // not centimetres
  const shapes::Plane plane;
  CHECK(shapes::createMeshFromShape(&plane) == nullptr);

  for (unsigned int i = 0; i < sphere->vertex_count; ++i) {
    const Eigen::Map<const Eigen::Vector3d> normal(sphere->vertex_normals + 3 * i);
    if (normal.dot(vertex(*sphere, i).normalized()) > 0.999) continue;
    CHECK(!"a normal of a sphere points away from its middle");
    break;
  }
  shapes::Mesh grown(*sphere);
  grown.scaleAndPadd(2.0, 0.25);
  CHECK(isNear(shapes::computeShapeExtents(&grown).z(), 2.5, 1e-3) && isNear(shapes::computeShapeExtents(sphere.get()).z(), 1.0));

  EigenSTL::vector_Vector3d points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}};
  const MeshPtr square(shapes::createMeshFromVertices(points));
  CHECK(square->vertex_count == 4 && square->triangle_count == 2 && square->triangle_normals[2] == 1.0 && square->triangle_normals[5] == 1.0);
  CHECK(square->vertex_normals[2] == 1.0);
  points[3].x() = 1e-6;
  const MeshPtr cracked(shapes::createMeshFromVertices(points));
  CHECK(cracked->vertex_count == 5);
  cracked->mergeVertices(1e-9);
  CHECK(cracked->vertex_count == 5);
  cracked->mergeVertices(1e-5);
  CHECK(cracked->vertex_count == 4 && cracked->triangle_count == 2 && cracked->triangle_normals[5] == 1.0);
  CHECK(shapes::createMeshFromVertices({points[0], points[1], points[2]}, {0, 1, 3}) == nullptr);
  CHECK(shapes::createMeshFromVertices({points[0], points[1]}) == nullptr);
  shapes::Mesh filled(3, 1);
  CHECK(filled.vertices[8] == 0.0 && filled.triangles[2] == 0);
  shapes::Mesh none;
  none.scale(2.0);
  CHECK(none.vertex_count == 0 && shapes::computeShapeExtents(&none).isZero());

  std::vector<char> file;
  shapes::writeSTLBinary(box.get(), file);
  CHECK(file.size() == 84 + 12 * 50);
  const MeshPtr read(shapes::createMeshFromBinary(file.data(), file.size(), "box.stl"));
  CHECK(read && read->vertex_count == 8 && read->triangle_count == 12 && isNear(volume(*read), 6.0));
}

void checkTexts() {
  CHECK(text(shapes::Box(1.0, 2.0, 0.5)) == "box\n1 2 0.5\n");
  const MeshPtr box(shapes::createMeshFromShape(shapes::Box(1.0, 2.0, 3.0)));
  std::istringstream in(text(*box) + text(shapes::Cone(0.25, 2.0)) + text(shapes::Plane(1.0, 0.0, 0.0, 4.0)));
  const std::unique_ptr<shapes::Shape> mesh(shapes::constructShapeFromText(in)), cone(shapes::constructShapeFromText(in)),
      plane(shapes::constructShapeFromText(in)), end(shapes::constructShapeFromText(in));
  CHECK(mesh && mesh->type == shapes::MESH && isNear(volume(static_cast<shapes::Mesh&>(*mesh)), 6.0));
  CHECK(cone && static_cast<shapes::Cone&>(*cone).radius == 0.25 && plane && static_cast<shapes::Plane&>(*plane).d == 4.0 && !end);
  for (const char* wrong : {"mesh\n4000000000 4000000000\n0 0 0\n", "mesh\n3 1\n0 0 0\n1 0 0\n0 1 0\n0 1 3\n", "box\n1 2\n",
                            "sphere\n-1\n", "torus\n1 2\n", "mesh\n-1\n"}) {
    std::istringstream stream(wrong);
    CHECK(shapes::constructShapeFromText(stream) == nullptr);
  }
  CHECK(shapes::shapeStringName(nullptr).empty() && shapes::shapeStringName(box.get()) == "mesh");
}

void checkIsometries() {
  Eigen::Isometry3d pose(Eigen::AngleAxisd(0.4, Eigen::Vector3d(1.0, 2.0, 3.0).normalized()));
  pose.translation().x() = 5.0;
  CHECK(checkIsometry(pose));
  pose.linear().col(1) *= 1.5;
  CHECK(!checkIsometry(pose, 1e-6, false));
}

}  // namespace

int main() {
  checkSizes();
  checkMessages();
  checkSpheres();
  checkMeshes();
  checkTexts();
  checkIsometries();
  std::cout << made << " checks, " << failed << " failed" << std::endl;
  return failed == 0 ? 0 : 1;
}
