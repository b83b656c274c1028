#ifndef GAZEBO_PHYSICS_UNIVERSALJOINT_HH_
#define GAZEBO_PHYSICS_UNIVERSALJOINT_HH_

#include <gazebo/physics/Joint.hh>

#endif
