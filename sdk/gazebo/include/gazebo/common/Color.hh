// Color with the members r, g, b and a, as in Gazebo up to 9.
#ifndef GAZEBO_COMMON_COLOR_HH_
#define GAZEBO_COMMON_COLOR_HH_

#include <ignition/math/Color.hh>

namespace gazebo {
namespace common {

class Color {
 public:
  static const Color White, Black, Red, Green, Blue, Yellow, Purple;

  Color() : r(0), g(0), b(0), a(1) {}
  Color(float r, float g, float b, float a = 1.0f) : r(r), g(g), b(b), a(a) {}
  Color(const ignition::math::Color& c) : r(c.R()), g(c.G()), b(c.B()), a(c.A()) {}  // NOLINT: implicit
  operator ignition::math::Color() const { return ignition::math::Color(r, g, b, a); }
  ignition::math::Color Ign() const { return *this; }
  void Set(float nr = 1, float ng = 1, float nb = 1, float na = 1) { *this = Color(nr, ng, nb, na); }
  friend std::ostream& operator<<(std::ostream& out, const Color& c) {
    return out << c.r << ' ' << c.g << ' ' << c.b << ' ' << c.a;
  }
  friend std::istream& operator>>(std::istream& in, Color& c) { return in >> c.r >> c.g >> c.b >> c.a; }

  float r, g, b, a;
};

}  // namespace common
}  // namespace gazebo

#endif
