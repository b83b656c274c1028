#include "range_scan.h"

#include <algorithm>
#include <cmath>

namespace trundle::navigation {

namespace {

constexpr double kNeighborhood = 0.2;  // radius of a fitted line [m]
constexpr double kGap = 0.5;           // between two hits that are not of one surface [m]
constexpr int kMaxNeighbors = 12;      // to each side
constexpr double kFlatness = 0.1;      // highest ratio of a line's two variances
constexpr double kRoughness = 0.03;    // of a surface with the noise of the ranges [m]
constexpr double kParallel = 0.95;     // least cosine between the normals of one surface

// Sums of places about a first one.
struct Moments {
  double count = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;

  void add(double dx, double dy) {
    count += 1.0;
    x += dx;
    y += dy;
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
  }
};

void add_side(const std::vector<Point>& hits, std::size_t center, int step, Moments& moments) {
  auto last = static_cast<std::ptrdiff_t>(center);
  for (int k = 1; k <= kMaxNeighbors; ++k) {
    const std::ptrdiff_t next = static_cast<std::ptrdiff_t>(center) + step * k;
    if (next < 0 || next >= static_cast<std::ptrdiff_t>(hits.size())) return;
    const Point &a = hits[static_cast<std::size_t>(last)], &b = hits[static_cast<std::size_t>(next)];
    if (std::hypot(b.x - a.x, b.y - a.y) > kGap) return;
    const double dx = b.x - hits[center].x, dy = b.y - hits[center].y;
    if (k > 1 && std::hypot(dx, dy) > kNeighborhood) return;
    moments.add(dx, dy);
    last = next;
  }
}

}  // namespace

Point RangeScan::center() const {
  if (hits.empty()) return origin;
  Point sum{0.0, 0.0};
  for (const Point& hit : hits) sum = {sum.x + hit.x, sum.y + hit.y};
  const auto count = static_cast<double>(hits.size());
  return {sum.x / count, sum.y / count};
}

double RangeScan::reach() const {
  double reach = 0.0;
  for (const Point& hit : hits) reach = std::max(reach, std::hypot(hit.x, hit.y));
  return reach;
}

void find_normals(RangeScan& scan) {
  scan.normals.assign(scan.hits.size(), Point{0.0, 0.0});
  for (std::size_t i = 0; i < scan.hits.size(); ++i) {
    Moments m;
    m.add(0.0, 0.0);
    add_side(scan.hits, i, -1, m);
    add_side(scan.hits, i, 1, m);
    if (m.count < 3.0) continue;
    const double xx = m.xx - m.x * m.x / m.count, xy = m.xy - m.x * m.y / m.count, yy = m.yy - m.y * m.y / m.count;
    const double middle = 0.5 * (xx + yy), spread = std::hypot(0.5 * (xx - yy), xy);
    if (!(middle - spread < kFlatness * (middle + spread))) continue;
    const double along = 0.5 * std::atan2(2.0 * xy, xx - yy);
    Point normal{-std::sin(along), std::cos(along)};
    const double facing = normal.x * (scan.origin.x - scan.hits[i].x) + normal.y * (scan.origin.y - scan.hits[i].y);
    if (facing < 0.0) normal = {-normal.x, -normal.y};
    scan.normals[i] = normal;
  }
}

bool is_one_surface(const RangeScan& scan, std::size_t hit) {
  const Point &a = scan.hits[hit], &b = scan.hits[hit + 1], &n = scan.normals[hit], &m = scan.normals[hit + 1];
  const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
  if (!(length < kGap) || n.x * m.x + n.y * m.y < kParallel) return false;
  return std::abs(n.x * dx + n.y * dy) < (1.0 - kParallel) * length + kRoughness;
}

}  // namespace trundle::navigation
