// A path of straight lines whose corners are circular arcs (Kunz and Stilman 2012).
#pragma once

#include <vector>

#include "state_space.h"

namespace trundle::planning {

class BlendedPath {
 public:
  // Path through waypoints; arcs leave them by at most a tolerance. Equal neighbors count once.
  BlendedPath(const std::vector<State>& waypoints, double tolerance);

  double length() const { return ends_.empty() ? 0.0 : ends_.back(); }
  // Ends of the lines and arcs along the path, the start left out.
  const std::vector<double>& ends() const { return ends_; }

  // Point, tangent and curvature at a place of a part, which `part_at` gives.
  void evaluate(std::size_t part, double along, State& point, State& tangent, State& curvature) const;
  std::size_t part_at(double along) const;
  // True if the direction changes at the start of a part: nothing can pass there but at rest.
  bool has_corner_before(std::size_t part) const { return parts_[part].has_corner; }
  bool is_arc(std::size_t part) const { return parts_[part].radius > 0.0; }

 private:
  struct Part {
    double start = 0.0;   // along the path
    double radius = 0.0;  // 0: a line
    State origin;         // a line's first point, an arc's center
    State x, y;           // unit: a line's direction; an arc's axes, x to its first point
    bool has_corner = false;
  };

  void add_line(const State& from, const State& to, bool has_corner);
  void add_arc(const State& before, const State& corner, const State& after, double cut);

  std::vector<Part> parts_;
  std::vector<double> ends_;
};

}  // namespace trundle::planning
