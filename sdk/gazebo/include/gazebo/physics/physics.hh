// All of gazebo::physics.
#ifndef GAZEBO_PHYSICS_PHYSICS_HH_
#define GAZEBO_PHYSICS_PHYSICS_HH_

#include <gazebo/common/Plugin.hh>
#include <gazebo/physics/Base.hh>
#include <gazebo/physics/Collision.hh>
#include <gazebo/physics/Contact.hh>
#include <gazebo/physics/Entity.hh>
#include <gazebo/physics/Inertial.hh>
#include <gazebo/physics/Joint.hh>
#include <gazebo/physics/JointController.hh>
#include <gazebo/physics/JointWrench.hh>
#include <gazebo/physics/Link.hh>
#include <gazebo/physics/Model.hh>
#include <gazebo/physics/PhysicsEngine.hh>
#include <gazebo/physics/PhysicsIface.hh>
#include <gazebo/physics/PhysicsTypes.hh>
#include <gazebo/physics/PresetManager.hh>
#include <gazebo/physics/Shape.hh>
#include <gazebo/physics/SurfaceParams.hh>
#include <gazebo/physics/World.hh>

#endif
