#pragma once

namespace trundle {

// Turns a vector by a quaternion (w, x, y, z), or back.
inline void rotate(const double* q, const double* v, bool inverse, double* out) {
  const double w = inverse ? -q[0] : q[0], x = q[1], y = q[2], z = q[3];
  const double tx = 2 * (y * v[2] - z * v[1]), ty = 2 * (z * v[0] - x * v[2]), tz = 2 * (x * v[1] - y * v[0]);
  out[0] = v[0] + w * tx + y * tz - z * ty;
  out[1] = v[1] + w * ty + z * tx - x * tz;
  out[2] = v[2] + w * tz + x * ty - y * tx;
}

}  // namespace trundle
