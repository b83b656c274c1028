#ifndef GAZEBO_PHYSICS_FIXEDJOINT_HH_
#define GAZEBO_PHYSICS_FIXEDJOINT_HH_

#include <gazebo/physics/Joint.hh>

#endif
