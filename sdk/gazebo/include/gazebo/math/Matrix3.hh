#ifndef GAZEBO_MATH_MATRIX3_HH_
#define GAZEBO_MATH_MATRIX3_HH_
#include <gazebo/math/Quaternion.hh>
#endif
