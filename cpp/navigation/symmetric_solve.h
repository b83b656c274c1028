// Symmetric systems of three equations.
#pragma once

#include <array>
#include <cmath>
#include <limits>

namespace trundle::navigation {

// Inverse of a symmetric matrix xx, xy, yy, xt, yt, tt, in the same order; infinite where it is singular.
inline std::array<double, 6> symmetric_inverse(const std::array<double, 6>& m) {
  const auto [xx, xy, yy, xt, yt, tt] = m;
  const double a = yy * tt - yt * yt, b = xt * yt - xy * tt, c = xy * yt - yy * xt;
  const double determinant = xx * a + xy * b + xt * c;
  std::array<double, 6> inverse;
  if (!(std::abs(determinant) > 0.0)) {
    inverse.fill(std::numeric_limits<double>::infinity());
    return inverse;
  }
  const double scale = 1.0 / determinant;
  inverse = {a * scale,
             b * scale,
             (xx * tt - xt * xt) * scale,
             c * scale,
             (xy * xt - xx * yt) * scale,
             (xx * yy - xy * xy) * scale};
  return inverse;
}

// Product of a symmetric matrix and a vector.
inline std::array<double, 3> symmetric_product(const std::array<double, 6>& m, const std::array<double, 3>& v) {
  const auto [xx, xy, yy, xt, yt, tt] = m;
  return {xx * v[0] + xy * v[1] + xt * v[2], xy * v[0] + yy * v[1] + yt * v[2], xt * v[0] + yt * v[1] + tt * v[2]};
}

}  // namespace trundle::navigation
