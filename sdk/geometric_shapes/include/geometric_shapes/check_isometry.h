#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cassert>
#include <iostream>

#ifndef CHECK_ISOMETRY_PRECISION
#define CHECK_ISOMETRY_PRECISION Eigen::NumTraits<double>::dummy_precision()
#endif

/** Whether a transform only turns and moves, as Eigen::Isometry3d takes for granted. */
inline bool checkIsometry(const Eigen::Isometry3d& transform, const double precision = CHECK_ISOMETRY_PRECISION,
                          const bool printError = true) {
  const Eigen::Matrix3d linear = transform.matrix().topLeftCorner<3, 3>();
  const bool is_affine = transform.matrix().row(3).isApprox(Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0), precision);
  const bool is_rotation = (linear.transpose() * linear).isApprox(Eigen::Matrix3d::Identity(), 2.0 * precision);
  if (printError && !(is_affine && is_rotation))
    std::cerr << "not an isometry within " << precision << ":\n" << transform.matrix() << std::endl;
  return is_affine && is_rotation;
}

#ifdef NDEBUG
#define ASSERT_ISOMETRY(transform) (void)sizeof(transform);
#else
#define ASSERT_ISOMETRY(transform) \
  { assert(::checkIsometry(transform) && "Invalid isometry transform"); }
#endif
