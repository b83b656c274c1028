#include "geometric_shapes/shapes.h"

#include <ros/console.h>

#include <initializer_list>
#include <stdexcept>

namespace shapes {
namespace {

/** Throws where a length is negative. */
void requireLengths(const char* sentence, std::initializer_list<double> lengths) {
  for (const double length : lengths)
    if (length < 0.0) throw std::runtime_error(sentence);
}

constexpr const char* kSphere = "Sphere radius must be non-negative.";
constexpr const char* kCylinder = "Cylinder dimensions must be non-negative.";
constexpr const char* kCone = "Cone dimensions must be non-negative.";
constexpr const char* kBox = "Box dimensions must be non-negative.";

}  // namespace

const std::string Sphere::STRING_NAME = "sphere";
const std::string Cylinder::STRING_NAME = "cylinder";
const std::string Cone::STRING_NAME = "cone";
const std::string Box::STRING_NAME = "box";
const std::string Mesh::STRING_NAME = "mesh";
const std::string Plane::STRING_NAME = "plane";
const std::string OcTree::STRING_NAME = "octree";

std::ostream& operator<<(std::ostream& out, ShapeType type) {
  static const char* const names[] = {"unknown", "sphere", "cylinder", "cone", "box", "plane", "mesh", "octree"};
  return out << (type >= UNKNOWN_SHAPE && type <= OCTREE ? names[type] : "impossible");
}

void Shape::print(std::ostream& out) const { out << this << std::endl; }

Sphere::Sphere(double r) : radius(r) {
  requireLengths(kSphere, {r});
  type = SPHERE;
}

void Sphere::scaleAndPadd(double scale, double padd) {
  const double padded = radius * scale + padd;
  requireLengths(kSphere, {padded});
  radius = padded;
}

void Sphere::print(std::ostream& out) const { out << "Sphere[radius=" << radius << "]" << std::endl; }

Cylinder::Cylinder(double r, double l) : length(l), radius(r) {
  requireLengths(kCylinder, {r, l});
  type = CYLINDER;
}

void Cylinder::scaleAndPadd(double scaleRadius, double scaleLength, double paddRadius, double paddLength) {
  const double r = radius * scaleRadius + paddRadius, l = length * scaleLength + 2.0 * paddLength;
  requireLengths(kCylinder, {r, l});
  radius = r;
  length = l;
}

void Cylinder::print(std::ostream& out) const {
  out << "Cylinder[radius=" << radius << ", length=" << length << "]" << std::endl;
}

Cone::Cone(double r, double l) : length(l), radius(r) {
  requireLengths(kCone, {r, l});
  type = CONE;
}

void Cone::scaleAndPadd(double scaleRadius, double scaleLength, double paddRadius, double paddLength) {
  const double r = radius * scaleRadius + paddRadius, l = length * scaleLength + 2.0 * paddLength;
  requireLengths(kCone, {r, l});
  radius = r;
  length = l;
}

void Cone::print(std::ostream& out) const {
  out << "Cone[radius=" << radius << ", length=" << length << "]" << std::endl;
}

Box::Box(double x, double y, double z) : size{x, y, z} {
  requireLengths(kBox, {x, y, z});
  type = BOX;
}

void Box::scaleAndPadd(double scaleX, double scaleY, double scaleZ, double paddX, double paddY, double paddZ) {
  const double x = size[0] * scaleX + 2.0 * paddX, y = size[1] * scaleY + 2.0 * paddY,
               z = size[2] * scaleZ + 2.0 * paddZ;
  requireLengths(kBox, {x, y, z});
  size[0] = x;
  size[1] = y;
  size[2] = z;
}

void Box::print(std::ostream& out) const {
  out << "Box[x=" << size[0] << ", y=" << size[1] << ", z=" << size[2] << "]" << std::endl;
}

Plane::Plane(double pa, double pb, double pc, double pd) : a(pa), b(pb), c(pc), d(pd) { type = PLANE; }

void Plane::scaleAndPadd(double /*scale*/, double /*padd*/) { ROS_WARN("Planes cannot be scaled or padded"); }

void Plane::print(std::ostream& out) const {
  out << "Plane[a=" << a << ", b=" << b << ", c=" << c << ", d=" << d << "]" << std::endl;
}

void OcTree::scaleAndPadd(double /*scale*/, double /*padd*/) { ROS_WARN("OcTrees cannot be scaled or padded"); }

void OcTree::print(std::ostream& out) const {
  out << (octree ? "OcTree[a tree of octomap]" : "OcTree[NULL]") << std::endl;
}

}  // namespace shapes
