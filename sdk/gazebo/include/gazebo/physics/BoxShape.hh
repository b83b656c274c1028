#ifndef GAZEBO_PHYSICS_BOXSHAPE_HH_
#define GAZEBO_PHYSICS_BOXSHAPE_HH_
#include <gazebo/physics/Shape.hh>
#endif
