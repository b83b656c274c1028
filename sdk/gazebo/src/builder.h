// Makes the objects of a world from its elements.
#pragma once

#include <string>

#include <sdf/sdf.hh>

#include <gazebo/physics/World.hh>

namespace gazebo {
namespace physics {

// Read elements: for each its depth, name, value, number of attributes, and their names and values, each with a 0 after
// it. Null if there is none.
sdf::ElementPtr read_elements(const char* text, int64_t size);

struct Builder {
  static void SetHost(const WorldPtr& world, const TrundleGazeboHost* host, const sdf::ElementPtr& sdf);
  static ModelPtr AddModel(const WorldPtr& world, const std::string& name, const sdf::ElementPtr& sdf);
  static void RemoveModel(const WorldPtr& world, const std::string& name);
  static void CountPlugin(const ModelPtr& model);

 private:
  static LinkPtr AddLink(const ModelPtr& model, const sdf::ElementPtr& sdf);
  static void AddCollision(const LinkPtr& link, const sdf::ElementPtr& sdf);
  static void AddJoint(const ModelPtr& model, const sdf::ElementPtr& sdf);
  static ShapePtr MakeShape(const CollisionPtr& collision, const sdf::ElementPtr& geometry);
};

}  // namespace physics
}  // namespace gazebo
