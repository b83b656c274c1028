#include "blended_path.h"

#include <algorithm>
#include <cmath>

namespace trundle::planning {

namespace {

constexpr double kShortest = 1e-9;
constexpr double kStraight = 1e-4;  // [rad] angle below which a corner is none

double product(const State& a, const State& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

State moved(const State& a, double by, const State& b) {
  State sum(a);
  for (std::size_t i = 0; i < a.size(); ++i) sum[i] += by * b[i];
  return sum;
}

double distance(const State& a, const State& b) {
  const State d = moved(b, -1.0, a);
  return std::sqrt(product(d, d));
}

State direction(const State& from, const State& to) {
  State d = moved(to, -1.0, from);
  const double length = std::sqrt(product(d, d));
  for (double& value : d) value /= length;
  return d;
}

}  // namespace

BlendedPath::BlendedPath(const std::vector<State>& waypoints, double tolerance) {
  std::vector<State> corners;
  for (const State& waypoint : waypoints)
    if (corners.empty() || distance(corners.back(), waypoint) > kShortest) corners.push_back(waypoint);
  if (corners.size() < 2) return;
  State at = corners.front();
  bool has_corner = false;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const State in = direction(corners[i - 1], corners[i]), out = direction(corners[i], corners[i + 1]);
    const double turn = std::acos(std::clamp(product(in, out), -1.0, 1.0));
    const double room = 0.5 * std::min(distance(corners[i - 1], corners[i]), distance(corners[i], corners[i + 1]));
    // An arc that starts `cut` before the corner leaves it by cut · tan(turn / 4).
    const double cut = turn < kStraight ? 0.0 : std::min(room, tolerance / std::tan(0.25 * turn));
    if (cut <= kShortest || turn > 3.14) {  // straight on, or straight back: the corner itself
      add_line(at, corners[i], has_corner);
      has_corner = turn >= kStraight;
      at = corners[i];
      continue;
    }
    add_line(at, moved(corners[i], -cut, in), has_corner);
    has_corner = false;
    add_arc(in, corners[i], out, cut);
    at = moved(corners[i], cut, out);
  }
  add_line(at, corners.back(), has_corner);
}

void BlendedPath::add_line(const State& from, const State& to, bool has_corner) {
  const double length = distance(from, to);
  if (length <= kShortest) return;
  parts_.push_back({this->length(), 0.0, from, direction(from, to), {}, has_corner});
  ends_.push_back(this->length() + length);
}

void BlendedPath::add_arc(const State& in, const State& corner, const State& out, double cut) {
  const double turn = std::acos(std::clamp(product(in, out), -1.0, 1.0));
  const double radius = cut / std::tan(0.5 * turn);
  State bisector = moved(out, -1.0, in);
  const double size = std::sqrt(product(bisector, bisector));
  for (double& value : bisector) value /= size;
  const State center = moved(corner, radius / std::cos(0.5 * turn), bisector);
  Part part{length(), radius, center, direction(center, moved(corner, -cut, in)), in, false};
  parts_.push_back(std::move(part));
  ends_.push_back(length() + radius * turn);
}

std::size_t BlendedPath::part_at(double along) const {
  const auto after = std::upper_bound(ends_.begin(), ends_.end(), along);
  return std::min(static_cast<std::size_t>(after - ends_.begin()), ends_.size() - 1);
}

void BlendedPath::evaluate(std::size_t number, double along, State& point, State& tangent, State& curvature) const {
  const Part& part = parts_[number];
  const double s = std::clamp(along, part.start, ends_[number]) - part.start;
  const std::size_t n = part.origin.size();
  point.resize(n);
  tangent.resize(n);
  curvature.resize(n);
  if (part.radius <= 0.0) {
    for (std::size_t i = 0; i < n; ++i) {
      point[i] = part.origin[i] + s * part.x[i];
      tangent[i] = part.x[i];
      curvature[i] = 0.0;
    }
    return;
  }
  const double sine = std::sin(s / part.radius), cosine = std::cos(s / part.radius);
  for (std::size_t i = 0; i < n; ++i) {
    point[i] = part.origin[i] + part.radius * (cosine * part.x[i] + sine * part.y[i]);
    tangent[i] = -sine * part.x[i] + cosine * part.y[i];
    curvature[i] = -(cosine * part.x[i] + sine * part.y[i]) / part.radius;
  }
}

}  // namespace trundle::planning
