#ifndef GAZEBO_PHYSICS_PHYSICSIFACE_HH_
#define GAZEBO_PHYSICS_PHYSICSIFACE_HH_
#include <gazebo/physics/World.hh>
#endif
