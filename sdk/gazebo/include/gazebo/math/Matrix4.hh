#ifndef GAZEBO_MATH_MATRIX4_HH_
#define GAZEBO_MATH_MATRIX4_HH_
#include <gazebo/math/Quaternion.hh>
#endif
