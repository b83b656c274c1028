// Box along the axes, from its smallest corner to its largest.
#ifndef IGNITION_MATH_BOX_HH_
#define IGNITION_MATH_BOX_HH_

#include <ignition/math/Vector3.hh>

namespace ignition {
namespace math {

class AxisAlignedBox {
 public:
  AxisAlignedBox() : low(MAX_D, MAX_D, MAX_D), high(LOW_D, LOW_D, LOW_D) {}
  AxisAlignedBox(const Vector3d& a, const Vector3d& b) : low(a), high(a) {
    low.Min(b);
    high.Max(b);
  }
  AxisAlignedBox(double x1, double y1, double z1, double x2, double y2, double z2)
      : AxisAlignedBox(Vector3d(x1, y1, z1), Vector3d(x2, y2, z2)) {}

  const Vector3d& Min() const { return low; }
  const Vector3d& Max() const { return high; }
  Vector3d& Min() { return low; }
  Vector3d& Max() { return high; }
  double XLength() const { return std::max(0.0, high.X() - low.X()); }
  double YLength() const { return std::max(0.0, high.Y() - low.Y()); }
  double ZLength() const { return std::max(0.0, high.Z() - low.Z()); }
  Vector3d Size() const { return {XLength(), YLength(), ZLength()}; }
  Vector3d Center() const { return (low + high) * 0.5; }
  double Volume() const { return XLength() * YLength() * ZLength(); }
  void Merge(const AxisAlignedBox& o) {
    low.Min(o.low);
    high.Max(o.high);
  }
  bool Intersects(const AxisAlignedBox& o) const {
    for (int i = 0; i < 3; ++i)
      if (high[i] < o.low[i] || low[i] > o.high[i]) return false;
    return true;
  }
  bool Contains(const Vector3d& point) const {
    for (int i = 0; i < 3; ++i)
      if (point[i] < low[i] || point[i] > high[i]) return false;
    return true;
  }
  AxisAlignedBox operator+(const AxisAlignedBox& o) const {
    AxisAlignedBox result = *this;
    result.Merge(o);
    return result;
  }
  AxisAlignedBox operator-(const Vector3d& v) const { return {low - v, high - v}; }
  AxisAlignedBox operator+(const Vector3d& v) const { return {low + v, high + v}; }
  bool operator==(const AxisAlignedBox& o) const { return low == o.low && high == o.high; }
  friend std::ostream& operator<<(std::ostream& out, const AxisAlignedBox& box) {
    return out << "Min[" << box.low << "] Max[" << box.high << "]";
  }

 private:
  Vector3d low, high;
};

typedef AxisAlignedBox Box;

}  // namespace math
}  // namespace ignition

#endif
