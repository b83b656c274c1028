// Costs of costmap_2d, and the shape of a grid in row-major order; row 0 is at the smallest y.
#pragma once

#include <cstddef>
#include <cstdint>

namespace trundle {

constexpr std::uint8_t kFreeSpace = 0;
constexpr std::uint8_t kLethalObstacle = 254;
constexpr std::uint8_t kNoInformation = 255;

struct GridShape {
  int width;
  int height;

  [[nodiscard]] bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  [[nodiscard]] std::size_t size() const { return index(0, height); }
};

// Calls visit(x, y) for each cell of Bresenham's line, at most `count` of them; visit returns false to stop.
template <typename Visit>
void visit_line(int x0, int y0, int x1, int y1, int count, Visit visit) {
  const int dx = x1 > x0 ? x1 - x0 : x0 - x1;
  const int dy = y1 > y0 ? y1 - y0 : y0 - y1;
  const int step_x = x1 > x0 ? 1 : -1;
  const int step_y = y1 > y0 ? 1 : -1;
  int error = dx - dy;
  for (int i = 0; i < count; ++i) {
    if (!visit(x0, y0) || (x0 == x1 && y0 == y1)) return;
    const int twice = 2 * error;
    if (twice > -dy) {
      error -= dy;
      x0 += step_x;
    }
    if (twice < dx) {
      error += dx;
      y0 += step_y;
    }
  }
}

}  // namespace trundle
