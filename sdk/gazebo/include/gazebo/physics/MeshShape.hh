#ifndef GAZEBO_PHYSICS_MESHSHAPE_HH_
#define GAZEBO_PHYSICS_MESHSHAPE_HH_
#include <gazebo/physics/Shape.hh>
#endif
