#ifndef GAZEBO_PHYSICS_HINGEJOINT_HH_
#define GAZEBO_PHYSICS_HINGEJOINT_HH_

#include <gazebo/physics/Joint.hh>

#endif
