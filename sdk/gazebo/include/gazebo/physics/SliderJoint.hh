#ifndef GAZEBO_PHYSICS_SLIDERJOINT_HH_
#define GAZEBO_PHYSICS_SLIDERJOINT_HH_

#include <gazebo/physics/Joint.hh>

#endif
