#include "inflation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trundle {

namespace {

constexpr std::uint8_t kInscribed = 253;
constexpr std::uint32_t kFar = std::numeric_limits<std::uint32_t>::max() / 2;

// Squared distance along a row from each column of the window to the nearest lethal cell; false if no lethal cell is
// near.
bool measure_row(const std::uint8_t* row, int width, Window window, int radius, std::uint32_t* squares) {
  const int first = std::max(window.x0 - radius, 0);
  const int last = std::min(window.x1 + radius, width) - 1;
  bool any = false;
  int seen = -width - radius;
  for (int x = first; x < window.x1; ++x) {
    if (row[x] == kLethalObstacle) seen = x;
    if (x < window.x0) continue;
    const int distance = x - seen;
    squares[x - window.x0] = distance <= radius ? static_cast<std::uint32_t>(distance * distance) : kFar;
    any |= distance <= radius;
  }
  seen = 2 * width + radius;
  for (int x = last; x >= window.x0; --x) {
    if (row[x] == kLethalObstacle) seen = x;
    const int distance = seen - x;
    if (x >= window.x1 || distance > radius) continue;
    squares[x - window.x0] = std::min(squares[x - window.x0], static_cast<std::uint32_t>(distance * distance));
    any = true;
  }
  return any;
}

}  // namespace

void inflate(std::uint8_t* cells, GridShape shape, Window window, const std::vector<std::uint8_t>& costs,
             bool inflate_unknown) {
  const int columns = window.x1 - window.x0;
  if (costs.empty() || columns <= 0 || window.y1 <= window.y0) return;
  const auto reach = static_cast<std::uint32_t>(costs.size() - 1);
  const int radius = static_cast<int>(std::sqrt(static_cast<double>(reach)));
  const int first = std::max(window.y0 - radius, 0);
  const int last = std::min(window.y1 + radius, shape.height);
  const auto stride = static_cast<std::size_t>(columns);
  std::vector<std::uint32_t> squares(stride * static_cast<std::size_t>(last - first));
  std::vector<char> is_near(static_cast<std::size_t>(last - first));
  for (int y = first; y < last; ++y) {
    const auto row = static_cast<std::size_t>(y - first);
    is_near[row] = measure_row(cells + shape.index(0, y), shape.width, window, radius, &squares[row * stride]);
  }
  std::vector<std::uint32_t> nearest(stride);
  for (int y = window.y0; y < window.y1; ++y) {
    std::fill(nearest.begin(), nearest.end(), kFar);
    for (int other = std::max(y - radius, first); other < std::min(y + radius + 1, last); ++other) {
      const auto row = static_cast<std::size_t>(other - first);
      if (!is_near[row]) continue;
      const auto rise = static_cast<std::uint32_t>((other - y) * (other - y));
      const std::uint32_t* along = &squares[row * stride];
      for (std::size_t x = 0; x < stride; ++x) nearest[x] = std::min(nearest[x], along[x] + rise);
    }
    std::uint8_t* row = cells + shape.index(window.x0, y);
    for (std::size_t x = 0; x < stride; ++x) {
      if (nearest[x] > reach) continue;
      const std::uint8_t cost = costs[nearest[x]];
      if (row[x] != kNoInformation) row[x] = std::max(row[x], cost);
      else if (inflate_unknown ? cost > kFreeSpace : cost >= kInscribed) row[x] = cost;
    }
  }
}

}  // namespace trundle
