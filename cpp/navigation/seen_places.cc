#include "seen_places.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace trundle::navigation {

namespace {

constexpr double kBeside = 0.15;     // distance along a surface that must have been seen, too [m]
constexpr double kTolerance = 0.25;  // of ranges: of poses and of the ground between two beams [m]
constexpr double kSurfaceGap = 1.0;  // farther ends are not of one surface [m]

}  // namespace

SeenPlaces::SeenPlaces(const std::vector<double>& bearings, double usable_range)
    : bearings_(bearings),
      usable_range_(usable_range),
      step_(bearings.size() < 2 ? 0.0
                                : (bearings.back() - bearings.front()) / static_cast<double>(bearings.size() - 1)) {}

bool SeenPlaces::has_end(const std::vector<float>& ranges, std::size_t beam) const {
  return ranges[beam] > 0.0f && double{ranges[beam]} <= usable_range_;
}

SeenPlaces::Point SeenPlaces::end_of(const RegisteredScan& scan, std::size_t beam) const {
  const double range = double{(*scan.ranges)[beam]}, angle = scan.pose.yaw + bearings_[beam];
  return {scan.pose.x + range * std::cos(angle), scan.pose.y + range * std::sin(angle)};
}

// Unit vector along the surface at a beam's end; across the beam if its neighbors are of no common surface.
SeenPlaces::Point SeenPlaces::direction_of_surface(const RegisteredScan& scan, std::size_t beam) const {
  if (beam > 0 && beam + 1 < bearings_.size() && has_end(*scan.ranges, beam - 1) && has_end(*scan.ranges, beam + 1)) {
    const Point before = end_of(scan, beam - 1), after = end_of(scan, beam + 1);
    const double x = after.x - before.x, y = after.y - before.y, length = std::hypot(x, y);
    if (length > 0.0 && length < kSurfaceGap) return {x / length, y / length};
  }
  const double angle = scan.pose.yaw + bearings_[beam];
  return {-std::sin(angle), std::cos(angle)};
}

// True if something at the place would have been hit, or something shortly before it was.
bool SeenPlaces::sees(const RegisteredScan& scan, const Point& place) const {
  const double x = place.x - scan.pose.x, y = place.y - scan.pose.y, range = std::hypot(x, y);
  if (!(range <= usable_range_)) return false;
  double turn = normalized_angle(std::atan2(y, x) - scan.pose.yaw - bearings_.front());
  const double around = 2.0 * std::numbers::pi;
  if (turn * step_ < 0.0) turn += step_ > 0.0 ? around : -around;
  const double beam = std::round(turn / step_), last = static_cast<double>(bearings_.size() - 1);
  if (!(beam <= last)) return false;
  const auto first = static_cast<std::size_t>(std::max(0.0, beam - 1.0));
  const auto end = static_cast<std::size_t>(std::min(last, beam + 1.0));
  for (std::size_t i = first; i <= end; ++i)
    if (double{(*scan.ranges)[i]} >= range - kTolerance) return true;
  return false;
}

std::vector<char> SeenPlaces::seen_ends(const RegisteredScan& scan, const std::vector<RegisteredScan>& earlier) const {
  std::vector<char> seen(bearings_.size(), 1);
  if (!(std::abs(step_) > 0.0)) return seen;
  for (std::size_t beam = 0; beam < bearings_.size(); ++beam) {
    if (!has_end(*scan.ranges, beam)) continue;
    const Point end = end_of(scan, beam), along = direction_of_surface(scan, beam);
    for (const double way : std::array<double, 2>{kBeside, -kBeside}) {
      const Point beside{end.x + way * along.x, end.y + way * along.y};
      const bool is_seen =
          std::any_of(earlier.begin(), earlier.end(), [&](const RegisteredScan& other) { return sees(other, beside); });
      if (!is_seen) seen[beam] = 0;
    }
  }
  return seen;
}

}  // namespace trundle::navigation
