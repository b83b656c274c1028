#pragma once

#define TF_SCALAR_H  // by which programs know that it is included

#include <tf2/LinearMath/Scalar.h>

typedef tf2Scalar tfScalar;

#define TFSIMD_PI TF2SIMD_PI
#define TFSIMD_2_PI TF2SIMD_2_PI
#define TFSIMD_HALF_PI TF2SIMD_HALF_PI
#define TFSIMD_RADS_PER_DEG TF2SIMD_RADS_PER_DEG
#define TFSIMD_DEGS_PER_RAD TF2SIMD_DEGS_PER_RAD
