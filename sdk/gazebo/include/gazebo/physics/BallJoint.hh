#ifndef GAZEBO_PHYSICS_BALLJOINT_HH_
#define GAZEBO_PHYSICS_BALLJOINT_HH_

#include <gazebo/physics/Joint.hh>

#endif
