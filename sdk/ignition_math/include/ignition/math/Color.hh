// Color with alpha, each from 0 to 1.
#ifndef IGNITION_MATH_COLOR_HH_
#define IGNITION_MATH_COLOR_HH_

#include <istream>
#include <ostream>

#include <ignition/math/Helpers.hh>

namespace ignition {
namespace math {

class Color {
 public:
  static const Color White, Black, Red, Green, Blue, Yellow, Magenta, Cyan;

  Color() : r(0), g(0), b(0), a(1) {}
  Color(float red, float green, float blue, float alpha = 1.0f) : r(red), g(green), b(blue), a(alpha) { Clamp(); }

  void Set(float red = 1, float green = 1, float blue = 1, float alpha = 1) { *this = Color(red, green, blue, alpha); }
  void Reset() { *this = Color(0, 0, 0, 0); }
  float R() const { return r; }
  float G() const { return g; }
  float B() const { return b; }
  float A() const { return a; }
  float& R() { return r; }
  float& G() { return g; }
  float& B() { return b; }
  float& A() { return a; }
  void R(float value) { r = value; }
  void G(float value) { g = value; }
  void B(float value) { b = value; }
  void A(float value) { a = value; }
  float operator[](unsigned int index) const { return index == 0 ? r : index == 1 ? g : index == 2 ? b : a; }

  Color operator+(const Color& o) const { return {r + o.r, g + o.g, b + o.b, a + o.a}; }
  Color operator-(const Color& o) const { return {r - o.r, g - o.g, b - o.b, a - o.a}; }
  Color operator*(const Color& o) const { return {r * o.r, g * o.g, b * o.b, a * o.a}; }
  Color operator*(float value) const { return {r * value, g * value, b * value, a * value}; }
  bool operator==(const Color& o) const { return equal(r, o.r) && equal(g, o.g) && equal(b, o.b) && equal(a, o.a); }
  bool operator!=(const Color& o) const { return !(*this == o); }
  friend std::ostream& operator<<(std::ostream& out, const Color& c) {
    return out << c.r << ' ' << c.g << ' ' << c.b << ' ' << c.a;
  }
  friend std::istream& operator>>(std::istream& in, Color& c) {
    if (in >> c.r >> c.g >> c.b && !(in >> c.a)) {
      c.a = 1;
      in.clear(in.rdstate() & ~std::ios::failbit);
    }
    return in;
  }

 private:
  void Clamp() {
    r = clamp(r, 0.0f, 1.0f);
    g = clamp(g, 0.0f, 1.0f);
    b = clamp(b, 0.0f, 1.0f);
    a = clamp(a, 0.0f, 1.0f);
  }

  float r, g, b, a;
};

}  // namespace math
}  // namespace ignition

#endif
