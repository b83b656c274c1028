// All of the kit's ignition-math.
#ifndef IGNITION_MATH_HH_
#define IGNITION_MATH_HH_

#include <ignition/math/Angle.hh>
#include <ignition/math/Box.hh>
#include <ignition/math/Color.hh>
#include <ignition/math/Helpers.hh>
#include <ignition/math/Inertial.hh>
#include <ignition/math/Matrix3.hh>
#include <ignition/math/Matrix4.hh>
#include <ignition/math/Pose3.hh>
#include <ignition/math/Quaternion.hh>
#include <ignition/math/Rand.hh>
#include <ignition/math/Vector2.hh>
#include <ignition/math/Vector3.hh>
#include <ignition/math/Vector4.hh>
#include <ignition/math/config.hh>

#endif
