// Contacts between collisions.
#ifndef GAZEBO_PHYSICS_CONTACT_HH_
#define GAZEBO_PHYSICS_CONTACT_HH_

#include <gazebo/common/Time.hh>
#include <gazebo/msgs/msgs.hh>
#include <gazebo/physics/JointWrench.hh>
#include <gazebo/physics/PhysicsTypes.hh>

#define MAX_CONTACT_JOINTS 250

namespace gazebo {
namespace physics {

class Contact {
 public:
  Contact() : collision1(nullptr), collision2(nullptr), count(0) {}
  // Read a message: its points, and those collisions that exist.
  Contact& operator=(const msgs::Contact& message);

  WorldPtr world;
  Collision* collision1;
  Collision* collision2;
  int count;
  common::Time time;
  WrenchVector positions[MAX_CONTACT_JOINTS];
  WrenchVector normals[MAX_CONTACT_JOINTS];
  JointWrench wrench[MAX_CONTACT_JOINTS];
  double depths[MAX_CONTACT_JOINTS];
};

}  // namespace physics
}  // namespace gazebo

#endif
