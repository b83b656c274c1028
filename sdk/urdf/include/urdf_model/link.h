#pragma once

#include <map>
#include <string>
#include <vector>

#include "urdf_model/color.h"
#include "urdf_model/joint.h"

namespace urdf {

class Geometry {
 public:
  enum { SPHERE, BOX, CYLINDER, MESH } type;
  virtual ~Geometry() {}
};
class Sphere : public Geometry {
 public:
  Sphere() { type = SPHERE; }
  double radius = 0.0;
};
class Box : public Geometry {
 public:
  Box() { type = BOX; }
  Vector3 dim;
};
class Cylinder : public Geometry {
 public:
  Cylinder() { type = CYLINDER; }
  double length = 0.0, radius = 0.0;
};
class Mesh : public Geometry {
 public:
  Mesh() { type = MESH; }
  std::string filename;
  Vector3 scale = Vector3(1, 1, 1);
};

class Material {
 public:
  std::string name, texture_filename;
  Color color;
};
/** Mass [kg], and inertia about the center of mass in the frame of `origin` [kg·m²]. */
class Inertial {
 public:
  Pose origin;
  double mass = 0.0, ixx = 0.0, ixy = 0.0, ixz = 0.0, iyy = 0.0, iyz = 0.0, izz = 0.0;
};
class Visual {
 public:
  Pose origin;
  GeometrySharedPtr geometry;
  std::string material_name, name;
  MaterialSharedPtr material;
};
class Collision {
 public:
  Pose origin;
  GeometrySharedPtr geometry;
  std::string name;
};

class Link {
 public:
  std::string name;
  InertialSharedPtr inertial;
  /** First of `visual_array`; null if it is empty. */
  VisualSharedPtr visual;
  CollisionSharedPtr collision;
  std::vector<CollisionSharedPtr> collision_array;
  std::vector<VisualSharedPtr> visual_array;
  JointSharedPtr parent_joint;
  std::vector<JointSharedPtr> child_joints;
  std::vector<LinkSharedPtr> child_links;

  LinkSharedPtr getParent() const { return parent_link_.lock(); }
  void setParent(const LinkSharedPtr& parent) { parent_link_ = parent; }

 private:
  LinkWeakPtr parent_link_;
};

}  // namespace urdf
