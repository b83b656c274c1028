#ifndef GAZEBO_PHYSICS_SPHERESHAPE_HH_
#define GAZEBO_PHYSICS_SPHERESHAPE_HH_
#include <gazebo/physics/Shape.hh>
#endif
