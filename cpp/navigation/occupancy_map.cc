#include "occupancy_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trundle::navigation {

namespace {

constexpr std::int8_t kOccupied = 100;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Lower envelope of the parabolas (q - i)^2 + squares[i], evaluated at each q.
class Envelope {
 public:
  explicit Envelope(std::size_t size) : vertices_(size), bounds_(size + 1) {}

  void transform(const std::vector<double>& squares, std::vector<double>& result) {
    const int size = static_cast<int>(squares.size());
    int last = -1;
    for (int q = 0; q < size; ++q) {
      if (squares[index(q)] == kInfinity) continue;
      double bound = -kInfinity;
      while (last >= 0) {
        bound = intersection(squares, vertices_[index(last)], q);
        if (bound > bounds_[index(last)]) break;
        --last;
      }
      if (last < 0) bound = -kInfinity;
      vertices_[index(++last)] = q;
      bounds_[index(last)] = bound;
    }
    if (last < 0) {
      std::fill(result.begin(), result.end(), kInfinity);
      return;
    }
    bounds_[index(last + 1)] = kInfinity;
    for (int q = 0, k = 0; q < size; ++q) {
      while (bounds_[index(k + 1)] < q) ++k;
      const double offset = q - vertices_[index(k)];
      result[index(q)] = offset * offset + squares[index(vertices_[index(k)])];
    }
  }

 private:
  static std::size_t index(int i) { return static_cast<std::size_t>(i); }
  static double intersection(const std::vector<double>& squares, int a, int b) {
    return ((squares[index(b)] + double{1} * b * b) - (squares[index(a)] + double{1} * a * a)) / (2.0 * (b - a));
  }

  std::vector<int> vertices_;
  std::vector<double> bounds_;
};

}  // namespace

std::vector<float> distances_to_occupied(const OccupancyMap& map, double limit) {
  const auto width = static_cast<std::size_t>(map.width), height = static_cast<std::size_t>(map.height);
  std::vector<float> distances(width * height);
  if (distances.empty()) return distances;
  // Squared distances along the columns first, kept as lengths to save memory.
  std::vector<float> above(width, std::numeric_limits<float>::infinity());
  for (std::size_t row = 0; row < height; ++row)
    for (std::size_t column = 0; column < width; ++column) {
      const std::size_t cell = row * width + column;
      above[column] = map.cells[cell] == kOccupied ? 0.0f : above[column] + 1.0f;
      distances[cell] = above[column];
    }
  for (std::size_t row = height - 1; row-- > 0;)
    for (std::size_t column = 0; column < width; ++column) {
      const std::size_t cell = row * width + column;
      distances[cell] = std::min(distances[cell], distances[cell + width] + 1.0f);
    }
  Envelope envelope(width);
  std::vector<double> squares(width), result(width);
  for (std::size_t row = 0; row < height; ++row) {
    float* line = distances.data() + row * width;
    for (std::size_t column = 0; column < width; ++column) squares[column] = double{line[column]} * line[column];
    envelope.transform(squares, result);
    for (std::size_t column = 0; column < width; ++column)
      line[column] = static_cast<float>(std::min(limit, map.resolution * std::sqrt(result[column])));
  }
  return distances;
}

double cast_ray(const OccupancyMap& map, double x, double y, double angle, double limit) {
  const double direction_x = std::cos(angle), direction_y = std::sin(angle);
  const double start_x = (x - map.origin_x) / map.resolution, start_y = (y - map.origin_y) / map.resolution;
  if (!(start_x >= 0.0 && start_y >= 0.0 && start_x < map.width && start_y < map.height)) return limit;
  int column = static_cast<int>(start_x), row = static_cast<int>(start_y);
  const int step_x = direction_x < 0.0 ? -1 : 1, step_y = direction_y < 0.0 ? -1 : 1;
  const double per_x = direction_x != 0.0 ? 1.0 / std::abs(direction_x) : kInfinity;
  const double per_y = direction_y != 0.0 ? 1.0 / std::abs(direction_y) : kInfinity;
  const auto first = [](double start, int cell, int step, double per) {
    return per == kInfinity ? kInfinity : (step > 0 ? cell + 1 - start : start - cell) * per;
  };
  double next_x = first(start_x, column, step_x, per_x), next_y = first(start_y, row, step_y, per_y);
  double length = 0.0;
  const double limit_cells = limit / map.resolution;
  while (length < limit_cells) {
    if (!map.contains(column, row)) return std::min(limit, length * map.resolution);
    if (map.at(column, row) != 0) return length * map.resolution;
    if (next_x < next_y) {
      length = next_x;
      next_x += per_x;
      column += step_x;
    } else {
      length = next_y;
      next_y += per_y;
      row += step_y;
    }
  }
  return limit;
}

}  // namespace trundle::navigation
