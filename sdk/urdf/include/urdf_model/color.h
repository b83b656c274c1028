#pragma once

namespace urdf {

class Color {
 public:
  Color() { clear(); }
  float r, g, b, a;
  void clear() {
    r = g = b = 0.0f;
    a = 1.0f;
  }
};

}  // namespace urdf
