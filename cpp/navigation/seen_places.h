// Places that a laser saw or could have seen from where it was.
#pragma once

#include <cstddef>
#include <vector>

#include "planar_pose.h"

namespace trundle::navigation {

struct RegisteredScan {
  PlanarPose pose;                   // of the laser in the map
  const std::vector<float>* ranges;  // [m]; 0: nothing was measured; infinity: nothing was hit
};

class SeenPlaces {
 public:
  // bearings: of a scan's beams, at equal steps [rad]; usable_range: up to which hits are kept [m].
  SeenPlaces(const std::vector<double>& bearings, double usable_range);

  // Which of a scan's beams end where an earlier scan would have had an end, too, if something is there.
  //
  // Beams at the last piece of a wall that is known are not among them: what lies beside them along the wall was not
  // seen. earlier: newest first.
  std::vector<char> seen_ends(const RegisteredScan& scan, const std::vector<RegisteredScan>& earlier) const;

 private:
  struct Point {
    double x, y;
  };

  bool has_end(const std::vector<float>& ranges, std::size_t beam) const;
  Point end_of(const RegisteredScan& scan, std::size_t beam) const;
  Point direction_of_surface(const RegisteredScan& scan, std::size_t beam) const;
  bool sees(const RegisteredScan& scan, const Point& place) const;

  std::vector<double> bearings_;
  double usable_range_, step_;
};

}  // namespace trundle::navigation
