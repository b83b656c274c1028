// Ends of a scan's beams on the robot, with the directions of the surfaces that they hit.
#pragma once

#include <cstddef>
#include <vector>

#include "occupancy_level.h"
#include "planar_pose.h"

namespace trundle::navigation {

// In the robot's frame [m].
struct RangeScan {
  Point origin{0.0, 0.0};      // of the beams
  std::vector<Point> hits;     // in the order of the beams
  std::vector<Point> normals;  // of the surfaces at the hits, of unit length toward the origin; zeros: unknown
  std::vector<Point> misses;   // ends of the free parts of the beams without a hit

  // Mean of the hits; the origin where there are none.
  Point center() const;
  // Distance of the farthest hit from the robot [m].
  double reach() const;
};

// Fits lines to neighboring hits.
void find_normals(RangeScan& scan);

// True if a hit and the next one are on one flat surface.
bool is_one_surface(const RangeScan& scan, std::size_t hit);

// A place on the robot, in the map.
struct Placement {
  double x, y, c, s;

  explicit Placement(const PlanarPose& pose) : x(pose.x), y(pose.y), c(std::cos(pose.yaw)), s(std::sin(pose.yaw)) {}
  Point operator()(const Point& p) const { return {x + c * p.x - s * p.y, y + s * p.x + c * p.y}; }
  Point turn(const Point& p) const { return {c * p.x - s * p.y, s * p.x + c * p.y}; }
};

}  // namespace trundle::navigation
