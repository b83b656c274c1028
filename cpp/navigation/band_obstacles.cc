#include "band_obstacles.h"

#include <cstddef>

namespace trundle::navigation {

namespace {

constexpr std::uint8_t kInscribed = 253;
constexpr std::array<std::array<int, 2>, 8> kNeighbors{
    {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};

}  // namespace

std::vector<std::array<double, 2>> obstacle_outline(const std::uint8_t* costs, const GridShape& shape) {
  std::vector<std::array<double, 2>> cells;
  for (int y = 0; y < shape.height; ++y)
    for (int x = 0; x < shape.width; ++x) {
      if (costs[shape.index(x, y)] != kLethalObstacle) continue;
      for (std::size_t k = 0; k < 4; ++k) {
        const int beside_x = x + kNeighbors[k][0], beside_y = y + kNeighbors[k][1];
        if (!shape.contains(beside_x, beside_y) || costs[shape.index(beside_x, beside_y)] == kLethalObstacle) continue;
        cells.push_back({static_cast<double>(x), static_cast<double>(y)});
        break;
      }
    }
  return cells;
}

std::vector<std::array<double, 2>> obstacle_islands(const std::uint8_t* costs, const GridShape& shape) {
  std::vector<std::array<double, 2>> islands;
  std::vector<bool> is_seen(shape.size());
  const auto is_blocked = [&](std::size_t i) { return costs[i] == kInscribed || costs[i] == kLethalObstacle; };
  std::vector<std::array<int, 2>> open;
  for (int y = 0; y < shape.height; ++y)
    for (int x = 0; x < shape.width; ++x) {
      if (is_seen[shape.index(x, y)] || !is_blocked(shape.index(x, y))) continue;
      bool touches_edge = false;
      open.assign(1, {x, y});
      is_seen[shape.index(x, y)] = true;
      while (!open.empty()) {
        const auto [at_x, at_y] = open.back();
        open.pop_back();
        for (const auto& [dx, dy] : kNeighbors) {
          if (!shape.contains(at_x + dx, at_y + dy)) {
            touches_edge = true;
            continue;
          }
          const std::size_t next = shape.index(at_x + dx, at_y + dy);
          if (is_seen[next] || !is_blocked(next)) continue;
          is_seen[next] = true;
          open.push_back({at_x + dx, at_y + dy});
        }
      }
      if (!touches_edge) islands.push_back({static_cast<double>(x), static_cast<double>(y)});
    }
  return islands;
}

}  // namespace trundle::navigation
