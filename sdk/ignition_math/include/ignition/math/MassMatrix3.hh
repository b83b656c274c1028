#ifndef IGNITION_MATH_MASSMATRIX3_HH_
#define IGNITION_MATH_MASSMATRIX3_HH_
#include <ignition/math/Inertial.hh>
#endif
