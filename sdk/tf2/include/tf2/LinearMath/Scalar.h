#pragma once

#define TF2_SCALAR_H  // by which programs know that it is included

#include <cfloat>
#include <cmath>
#include <cstdlib>

typedef double tf2Scalar;

#define TF2SIMD_PI 3.14159265358979323846
#define TF2SIMD_2_PI (2.0 * TF2SIMD_PI)
#define TF2SIMD_HALF_PI (0.5 * TF2SIMD_PI)
#define TF2SIMD_RADS_PER_DEG (TF2SIMD_PI / 180.0)
#define TF2SIMD_DEGS_PER_RAD (180.0 / TF2SIMD_PI)
#define TF2SIMD_EPSILON 2.2204460492503131e-16
