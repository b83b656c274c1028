#ifndef GAZEBO_MATH_VECTOR2I_HH_
#define GAZEBO_MATH_VECTOR2I_HH_
#include <gazebo/math/Vector3.hh>
#endif
