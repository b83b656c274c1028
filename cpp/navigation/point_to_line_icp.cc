#include "point_to_line_icp.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "symmetric_solve.h"

namespace trundle::navigation {

namespace {

constexpr double kMinRatio = 0.05;  // minimum share of a scan's points with a correspondence
constexpr double kDamping = 1e-6;   // damping of the normal equations per point
constexpr std::size_t kMinPoints = 4;

// Points in buckets whose size is that of the search.
class Buckets {
 public:
  Buckets(const std::vector<ScanPoint>& points, double size) : points_(points), size_(size) {
    for (std::size_t i = 0; i < points.size(); ++i)
      buckets_[key(cell(points[i].x), cell(points[i].y))].push_back(static_cast<int>(i));
  }

  // Nearest point within the size, of equally near ones the first; -1 if there is none.
  int nearest(double x, double y) const {
    double best = size_ * size_;
    int found = -1;
    const std::int64_t column = cell(x), row = cell(y);
    for (std::int64_t i = column - 1; i <= column + 1; ++i)
      for (std::int64_t j = row - 1; j <= row + 1; ++j) {
        const auto bucket = buckets_.find(key(i, j));
        if (bucket == buckets_.end()) continue;
        for (const int number : bucket->second) {
          const ScanPoint& point = points_[static_cast<std::size_t>(number)];
          const double square = (point.x - x) * (point.x - x) + (point.y - y) * (point.y - y);
          if (square < best || (square == best && found >= 0 && number < found)) {
            best = square;
            found = number;
          }
        }
      }
    return found;
  }

 private:
  std::int64_t cell(double place) const { return static_cast<std::int64_t>(std::floor(place / size_)); }
  static std::int64_t key(std::int64_t column, std::int64_t row) { return column * 1'000'003 + row; }

  const std::vector<ScanPoint>& points_;
  double size_;
  std::unordered_map<std::int64_t, std::vector<int>> buckets_;
};

// A point of the scan, and the corresponding line or point of the reference.
struct Pair {
  double px, py;        // point, rotated by the pose
  double ex, ey;        // offset from the reference to the point [m]
  double nx, ny;        // unit normal of the line
  double square = 0.0;  // square of the distance [m²]
};

// Normal of the line through a point of the reference and the nearer of its neighbors; false if there is no such line.
bool line_at(const std::vector<ScanPoint>& reference, int number, double x, double y, double limit, Pair& pair) {
  const auto distance = [&](int other) {
    if (other < 0 || other >= static_cast<int>(reference.size())) return HUGE_VAL;
    const ScanPoint& point = reference[static_cast<std::size_t>(other)];
    return std::hypot(point.x - x, point.y - y);
  };
  const int other = distance(number - 1) < distance(number + 1) ? number - 1 : number + 1;
  if (!(distance(other) < HUGE_VAL)) return false;
  const ScanPoint &a = reference[static_cast<std::size_t>(number)], &b = reference[static_cast<std::size_t>(other)];
  const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
  if (!(length > 0.0) || length > limit) return false;
  pair.nx = -dy / length;
  pair.ny = dx / length;
  return true;
}

std::vector<Pair> correspondences(const std::vector<ScanPoint>& reference, const Buckets& buckets,
                                  const std::vector<ScanPoint>& scan, const PlanarPose& pose,
                                  const IcpOptions& options) {
  std::vector<Pair> pairs;
  const double c = std::cos(pose.yaw), s = std::sin(pose.yaw);
  for (const ScanPoint& point : scan) {
    Pair pair{c * point.x - s * point.y, s * point.x + c * point.y, 0.0, 0.0, 0.0, 0.0};
    const double x = pose.x + pair.px, y = pose.y + pair.py;
    const int number = buckets.nearest(x, y);
    if (number < 0) continue;
    pair.ex = x - reference[static_cast<std::size_t>(number)].x;
    pair.ey = y - reference[static_cast<std::size_t>(number)].y;
    pair.square = pair.ex * pair.ex + pair.ey * pair.ey;
    if (options.uses_lines) {
      if (!line_at(reference, number, x, y, options.max_correspondence, pair)) continue;
      const double across = pair.nx * pair.ex + pair.ny * pair.ey;
      pair.square = across * across;
    }
    pairs.push_back(pair);
  }
  return pairs;
}

// Removes the pairs with the largest distances.
void trim(std::vector<Pair>& pairs, const IcpOptions& options) {
  if (pairs.size() < kMinPoints) return;
  std::vector<double> squares;
  for (const Pair& pair : pairs) squares.push_back(pair.square);
  std::sort(squares.begin(), squares.end());
  const auto quantile = [&](double ratio) {
    const double place = std::clamp(ratio, 0.0, 1.0) * static_cast<double>(squares.size() - 1);
    return squares[static_cast<std::size_t>(place)];
  };
  const double limit =
      std::min(quantile(options.max_ratio), options.adaptive_multiple * quantile(options.adaptive_order));
  std::erase_if(pairs, [limit](const Pair& pair) { return pair.square > limit; });
}

struct Sums {
  std::array<double, 6> hessian{};
  std::array<double, 3> gradient{};

  void add(double jx, double jy, double jt, double residual) {
    hessian[0] += jx * jx;
    hessian[1] += jx * jy;
    hessian[2] += jy * jy;
    hessian[3] += jx * jt;
    hessian[4] += jy * jt;
    hessian[5] += jt * jt;
    gradient[0] -= jx * residual;
    gradient[1] -= jy * residual;
    gradient[2] -= jt * residual;
  }
};

Sums sums_of(const std::vector<Pair>& pairs, bool uses_lines) {
  Sums sums;
  for (const Pair& pair : pairs) {
    if (uses_lines) {
      sums.add(pair.nx, pair.ny, pair.ny * pair.px - pair.nx * pair.py, pair.nx * pair.ex + pair.ny * pair.ey);
    } else {
      sums.add(1.0, 0.0, -pair.py, pair.ex);
      sums.add(0.0, 1.0, pair.px, pair.ey);
    }
  }
  const double damping = kDamping * static_cast<double>(pairs.size());
  for (const std::size_t i : {0, 2, 5}) sums.hessian[i] += damping;
  return sums;
}

}  // namespace

IcpMatch match_scans(const std::vector<ScanPoint>& reference, const std::vector<ScanPoint>& scan,
                     const PlanarPose& guess, const IcpOptions& options) {
  IcpMatch match;
  match.pose = guess;
  const Buckets buckets(reference, options.max_correspondence);
  std::vector<Pair> pairs;
  for (int iteration = 0; iteration < options.max_iterations; ++iteration) {
    pairs = correspondences(reference, buckets, scan, match.pose, options);
    if (pairs.size() < kMinPoints || static_cast<double>(pairs.size()) < kMinRatio * static_cast<double>(scan.size()))
      return match;
    trim(pairs, options);
    const Sums sums = sums_of(pairs, options.uses_lines);
    const std::array<double, 6> inverse = symmetric_inverse(sums.hessian);
    const std::array<double, 3> step = symmetric_product(inverse, sums.gradient);
    if (!std::isfinite(step[0] + step[1] + step[2])) return match;
    match.pose = {match.pose.x + step[0], match.pose.y + step[1], normalized_angle(match.pose.yaw + step[2])};
    for (std::size_t i = 0; i < 6; ++i) match.covariance[i] = options.sigma * options.sigma * inverse[i];
    if (std::hypot(step[0], step[1]) < options.epsilon_xy && std::abs(step[2]) < options.epsilon_theta) break;
  }
  double squares = 0.0;
  for (const Pair& pair : pairs) squares += pair.square;
  match.count = static_cast<int>(pairs.size());
  match.error = pairs.empty() ? 0.0 : std::sqrt(squares / static_cast<double>(pairs.size()));
  match.is_valid = !pairs.empty() && std::hypot(match.pose.x - guess.x, match.pose.y - guess.y) <= options.max_linear &&
                   std::abs(angle_difference(match.pose.yaw, guess.yaw)) <= options.max_angular;
  return match;
}

}  // namespace trundle::navigation
