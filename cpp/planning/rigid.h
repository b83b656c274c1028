// Vectors, rotations and rigid transforms of the planners.
#pragma once

#include <array>
#include <cmath>

namespace trundle::planning {

struct Vec3 {
  double x = 0.0, y = 0.0, z = 0.0;

  double operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
};

inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(double s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// Rotation matrix, row by row.
struct Rotation {
  std::array<double, 9> m{1, 0, 0, 0, 1, 0, 0, 0, 1};

  Vec3 column(int i) const {
    const auto k = static_cast<std::size_t>(i);
    return {m[k], m[k + 3], m[k + 6]};
  }
};

inline Vec3 operator*(const Rotation& r, const Vec3& v) {
  return {r.m[0] * v.x + r.m[1] * v.y + r.m[2] * v.z, r.m[3] * v.x + r.m[4] * v.y + r.m[5] * v.z,
          r.m[6] * v.x + r.m[7] * v.y + r.m[8] * v.z};
}

// The vector in the rotated frame: transpose times v.
inline Vec3 unrotate(const Rotation& r, const Vec3& v) {
  return {r.m[0] * v.x + r.m[3] * v.y + r.m[6] * v.z, r.m[1] * v.x + r.m[4] * v.y + r.m[7] * v.z,
          r.m[2] * v.x + r.m[5] * v.y + r.m[8] * v.z};
}

inline Rotation operator*(const Rotation& a, const Rotation& b) {
  Rotation c;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      c.m[3 * i + j] = a.m[3 * i] * b.m[j] + a.m[3 * i + 1] * b.m[3 + j] + a.m[3 * i + 2] * b.m[6 + j];
  return c;
}

inline Rotation transpose(const Rotation& r) {
  return {{r.m[0], r.m[3], r.m[6], r.m[1], r.m[4], r.m[7], r.m[2], r.m[5], r.m[8]}};
}

// Rotation by an angle [rad] about a unit axis (Rodrigues).
inline Rotation rotation_about(const Vec3& axis, double angle) {
  const double s = std::sin(angle), c = std::cos(angle), t = 1.0 - c;
  const auto [x, y, z] = axis;
  return {{t * x * x + c, t * x * y - s * z, t * x * z + s * y, t * x * y + s * z, t * y * y + c, t * y * z - s * x,
           t * x * z - s * y, t * y * z + s * x, t * z * z + c}};
}

// Rotation of a quaternion x, y, z, w of any length but zero.
inline Rotation rotation_of(double x, double y, double z, double w) {
  const double n = x * x + y * y + z * z + w * w, s = n > 0.0 ? 2.0 / n : 0.0;
  return {{1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w), s * (x * y + z * w),
           1 - s * (x * x + z * z), s * (y * z - x * w), s * (x * z - y * w), s * (y * z + x * w),
           1 - s * (x * x + y * y)}};
}

// Axis times angle, 0 ≤ angle ≤ π [rad].
inline Vec3 rotation_vector(const Rotation& r) {
  const Vec3 v{r.m[7] - r.m[5], r.m[2] - r.m[6], r.m[3] - r.m[1]};  // 2 sin(angle) axis
  const double sine = 0.5 * norm(v), cosine = 0.5 * (r.m[0] + r.m[4] + r.m[8] - 1.0);
  const double angle = std::atan2(sine, cosine);
  if (sine > 1e-6) return (0.5 * angle / sine) * v;
  if (cosine > 0.0) return 0.5 * v;
  // Half a turn: the longest column of R + 1 is along the axis.
  Vec3 best;
  for (int i = 0; i < 3; ++i) {
    Vec3 column = r.column(i);
    (i == 0 ? column.x : i == 1 ? column.y : column.z) += 1.0;
    if (dot(column, column) > dot(best, best)) best = column;
  }
  return (angle / norm(best)) * best;
}

// Pose of frame b in frame a.
struct Rigid {
  Rotation r;
  Vec3 p;
};

inline Vec3 operator*(const Rigid& a, const Vec3& v) { return a.r * v + a.p; }
inline Rigid operator*(const Rigid& a, const Rigid& b) { return {a.r * b.r, a.r * b.p + a.p}; }
inline Rigid inverse(const Rigid& a) {
  const Rotation r = transpose(a.r);
  return {r, -1.0 * (r * a.p)};
}

// Pose of x, y, z [m], qx, qy, qz, qw.
inline Rigid rigid_of(const double* row) {
  return {rotation_of(row[3], row[4], row[5], row[6]), {row[0], row[1], row[2]}};
}

}  // namespace trundle::planning
