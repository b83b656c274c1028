// All of gazebo::math.
#ifndef GAZEBO_MATH_GZMATH_HH_
#define GAZEBO_MATH_GZMATH_HH_

#include <gazebo/math/Angle.hh>
#include <gazebo/math/Box.hh>
#include <gazebo/math/Helpers.hh>
#include <gazebo/math/Pose.hh>
#include <gazebo/math/Quaternion.hh>
#include <gazebo/math/Rand.hh>
#include <gazebo/math/Vector3.hh>

#endif
