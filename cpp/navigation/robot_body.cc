#include "robot_body.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace trundle::navigation {

RobotBody::RobotBody(std::vector<BodyLine> lines, bool is_closed) : lines_(std::move(lines)), is_closed_(is_closed) {
  for (const BodyLine& line : lines_)
    for (const Point& end : {line.start, line.end}) reach_ = std::max(reach_, std::hypot(end[0], end[1]) + line.radius);
}

BodyDistance RobotBody::distance(const std::array<double, 3>& pose, const Point& point) const {
  const double c = std::cos(pose[2]), s = std::sin(pose[2]);
  const double dx = point[0] - pose[0], dy = point[1] - pose[1];
  const double x = c * dx + s * dy, y = c * dy - s * dx;  // the point in the robot's frame
  double least = std::numeric_limits<double>::infinity();
  Point nearest{}, gap{};
  bool is_inside = false;
  for (const BodyLine& line : lines_) {
    const double along_x = line.end[0] - line.start[0], along_y = line.end[1] - line.start[1];
    const double to_x = x - line.start[0], to_y = y - line.start[1];
    const double square = along_x * along_x + along_y * along_y;
    const double share = square > 0.0 ? std::clamp((to_x * along_x + to_y * along_y) / square, 0.0, 1.0) : 0.0;
    const Point foot{line.start[0] + share * along_x, line.start[1] + share * along_y};
    const double distance = std::hypot(x - foot[0], y - foot[1]) - line.radius;
    if (distance < least) {
      least = distance;
      nearest = foot;
      gap = {foot[0] - x, foot[1] - y};
    }
    // Even-odd rule: the side crosses the ray from the point toward +x.
    if ((line.start[1] > y) != (line.end[1] > y) && x < line.start[0] + along_x * (y - line.start[1]) / along_y)
      is_inside = !is_inside;
  }
  double norm = std::hypot(gap[0], gap[1]);
  if (norm < 1e-9) {
    norm = std::max(std::hypot(nearest[0], nearest[1]), 1e-9);
    gap = nearest;  // away from the robot's middle
  }
  const double sign = is_closed_ && is_inside ? -1.0 : 1.0;
  const double ux = sign * gap[0] / norm, uy = sign * gap[1] / norm;  // direction of growing distance, robot's frame
  // The foot turns with the robot: d(R foot)/dyaw = R (-foot.y, foot.x).
  return {sign * least, {c * ux - s * uy, s * ux + c * uy, uy * nearest[0] - ux * nearest[1]}};
}

}  // namespace trundle::navigation
