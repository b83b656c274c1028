// The outline of a robot as lines with a radius, and its distance from points.
#pragma once

#include <array>
#include <vector>

namespace trundle::navigation {

using Point = std::array<double, 2>;

struct BodyLine {
  Point start, end;  // in the robot's frame [m]
  double radius;     // [m]
};

struct BodyDistance {
  double distance;              // negative inside [m]
  std::array<double, 3> slope;  // derivatives by the robot's x, y and yaw
};

class RobotBody {
 public:
  // is_closed: the lines are the sides of a polygon, and what lies in it is inside.
  RobotBody(std::vector<BodyLine> lines, bool is_closed);

  // Distance between the body of a robot at x, y, yaw and a point.
  [[nodiscard]] BodyDistance distance(const std::array<double, 3>& pose, const Point& point) const;

  // Greatest distance of the body from the robot's origin [m].
  [[nodiscard]] double reach() const { return reach_; }

 private:
  std::vector<BodyLine> lines_;
  bool is_closed_;
  double reach_ = 0.0;
};

}  // namespace trundle::navigation
