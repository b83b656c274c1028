// Vector with the members x, y and z, as in Gazebo up to 8; it converts to ignition's and from it.
#ifndef GAZEBO_MATH_VECTOR3_HH_
#define GAZEBO_MATH_VECTOR3_HH_

#include <ignition/math/Vector2.hh>
#include <ignition/math/Vector3.hh>

#include <gazebo/math/Helpers.hh>

namespace gazebo {
namespace math {

class Vector3 {
 public:
  static const Vector3 Zero, One, UnitX, UnitY, UnitZ;

  Vector3() : x(0), y(0), z(0) {}
  Vector3(const double& x, const double& y, const double& z) : x(x), y(y), z(z) {}
  Vector3(const ignition::math::Vector3d& v) : x(v.X()), y(v.Y()), z(v.Z()) {}  // NOLINT: implicit as in the original
  operator ignition::math::Vector3d() const { return Ign(); }
  ignition::math::Vector3d Ign() const { return ignition::math::Vector3d(x, y, z); }

  void Set(double nx = 0, double ny = 0, double nz = 0) { *this = Vector3(nx, ny, nz); }
  double GetLength() const { return std::sqrt(GetSquaredLength()); }
  double GetSquaredLength() const { return Dot(*this); }
  double GetSum() const { return x + y + z; }
  double Distance(const Vector3& o) const { return (*this - o).GetLength(); }
  double Distance(double ox, double oy, double oz) const { return Distance(Vector3(ox, oy, oz)); }
  Vector3 Normalize() { return *this = Vector3(Ign().Normalize()); }
  Vector3 Round() { return *this = Vector3(std::nearbyint(x), std::nearbyint(y), std::nearbyint(z)); }
  Vector3 GetRounded() const { return Vector3(*this).Round(); }
  Vector3 Cross(const Vector3& o) const { return Ign().Cross(o.Ign()); }
  double Dot(const Vector3& o) const { return x * o.x + y * o.y + z * o.z; }
  Vector3 GetAbs() const { return Ign().Abs(); }
  Vector3 GetPerpendicular() const { return Ign().Perpendicular(); }
  static Vector3 GetNormal(const Vector3& a, const Vector3& b, const Vector3& c) {
    return ignition::math::Vector3d::Normal(a.Ign(), b.Ign(), c.Ign());
  }
  void SetToMax(const Vector3& o) { *this = Vector3(std::max(x, o.x), std::max(y, o.y), std::max(z, o.z)); }
  void SetToMin(const Vector3& o) { *this = Vector3(std::min(x, o.x), std::min(y, o.y), std::min(z, o.z)); }
  double GetMax() const { return Ign().Max(); }
  double GetMin() const { return Ign().Min(); }
  bool IsFinite() const { return Ign().IsFinite(); }
  void Correct() {
    ignition::math::Vector3d v = Ign();
    v.Correct();
    *this = v;
  }
  bool Equal(const Vector3& o) const { return *this == o; }

  double operator[](unsigned int index) const { return index == 0 ? x : index == 1 ? y : z; }
  Vector3 operator+(const Vector3& o) const { return {x + o.x, y + o.y, z + o.z}; }
  Vector3 operator-(const Vector3& o) const { return {x - o.x, y - o.y, z - o.z}; }
  Vector3 operator-() const { return {-x, -y, -z}; }
  Vector3 operator*(const Vector3& o) const { return {x * o.x, y * o.y, z * o.z}; }
  Vector3 operator/(const Vector3& o) const { return {x / o.x, y / o.y, z / o.z}; }
  Vector3 operator*(double value) const { return {x * value, y * value, z * value}; }
  Vector3 operator/(double value) const { return {x / value, y / value, z / value}; }
  friend Vector3 operator*(double value, const Vector3& v) { return v * value; }
  const Vector3& operator+=(const Vector3& o) { return *this = *this + o; }
  const Vector3& operator-=(const Vector3& o) { return *this = *this - o; }
  const Vector3& operator*=(const Vector3& o) { return *this = *this * o; }
  const Vector3& operator/=(const Vector3& o) { return *this = *this / o; }
  const Vector3& operator*=(double value) { return *this = *this * value; }
  const Vector3& operator/=(double value) { return *this = *this / value; }
  bool operator==(const Vector3& o) const { return Ign() == o.Ign(); }
  bool operator!=(const Vector3& o) const { return !(*this == o); }
  friend std::ostream& operator<<(std::ostream& out, const Vector3& v) {
    return out << v.x << ' ' << v.y << ' ' << v.z;
  }
  friend std::istream& operator>>(std::istream& in, Vector3& v) { return in >> v.x >> v.y >> v.z; }

  double x, y, z;
};

class Vector2d {
 public:
  Vector2d() : x(0), y(0) {}
  Vector2d(const double& x, const double& y) : x(x), y(y) {}
  Vector2d(const ignition::math::Vector2d& v) : x(v.X()), y(v.Y()) {}  // NOLINT: implicit as in the original
  operator ignition::math::Vector2d() const { return Ign(); }
  ignition::math::Vector2d Ign() const { return ignition::math::Vector2d(x, y); }
  void Set(double nx, double ny) { *this = Vector2d(nx, ny); }
  double Distance(const Vector2d& o) const { return Ign().Distance(o.Ign()); }
  double Dot(const Vector2d& o) const { return x * o.x + y * o.y; }
  Vector2d operator+(const Vector2d& o) const { return {x + o.x, y + o.y}; }
  Vector2d operator-(const Vector2d& o) const { return {x - o.x, y - o.y}; }
  Vector2d operator*(double value) const { return {x * value, y * value}; }
  Vector2d operator/(double value) const { return {x / value, y / value}; }
  bool operator==(const Vector2d& o) const { return Ign() == o.Ign(); }
  friend std::ostream& operator<<(std::ostream& out, const Vector2d& v) { return out << v.x << ' ' << v.y; }
  friend std::istream& operator>>(std::istream& in, Vector2d& v) { return in >> v.x >> v.y; }

  double x, y;
};

class Vector2i {
 public:
  Vector2i() : x(0), y(0) {}
  Vector2i(const int& x, const int& y) : x(x), y(y) {}
  friend std::istream& operator>>(std::istream& in, Vector2i& v) { return in >> v.x >> v.y; }

  int x, y;
};

}  // namespace math
}  // namespace gazebo

#endif
