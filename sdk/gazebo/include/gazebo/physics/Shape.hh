// Shapes of collisions.
#ifndef GAZEBO_PHYSICS_SHAPE_HH_
#define GAZEBO_PHYSICS_SHAPE_HH_

#include <gazebo/math/Vector3.hh>
#include <gazebo/physics/Base.hh>

namespace gazebo {
namespace physics {

class Shape : public Base {
 public:
  explicit Shape(BasePtr parent) : Base(parent) { type_ = SHAPE; }
};

class BoxShape : public Shape {
 public:
  explicit BoxShape(BasePtr parent) : Shape(parent) { type_ = SHAPE | BOX_SHAPE; }
  ignition::math::Vector3d Size() const { return size; }
  math::Vector3 GetSize() const { return size; }

  ignition::math::Vector3d size;
};

class CylinderShape : public Shape {
 public:
  explicit CylinderShape(BasePtr parent) : Shape(parent), radius(0), length(0) { type_ = SHAPE | CYLINDER_SHAPE; }
  double GetRadius() const { return radius; }
  double GetLength() const { return length; }

  double radius, length;
};

class SphereShape : public Shape {
 public:
  explicit SphereShape(BasePtr parent) : Shape(parent), radius(0) { type_ = SHAPE | SPHERE_SHAPE; }
  double GetRadius() const { return radius; }

  double radius;
};

class MeshShape : public Shape {
 public:
  explicit MeshShape(BasePtr parent) : Shape(parent) { type_ = SHAPE | MESH_SHAPE; }
  std::string GetMeshURI() const { return uri; }

  std::string uri;
};

}  // namespace physics
}  // namespace gazebo

#endif
