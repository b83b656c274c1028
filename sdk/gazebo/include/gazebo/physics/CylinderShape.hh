#ifndef GAZEBO_PHYSICS_CYLINDERSHAPE_HH_
#define GAZEBO_PHYSICS_CYLINDERSHAPE_HH_
#include <gazebo/physics/Shape.hh>
#endif
