// Distances of two convex shapes, by MuJoCo's GJK and EPA.
//
// A model of four geoms serves all shapes: two primitives whose type and size are set, and two meshes whose corners are
// replaced. So no shape that comes or goes is a compile.
#pragma once

#include <array>
#include <cstdint>

#include "convex_shape.h"

struct mjModel_;
struct mjData_;

namespace trundle::planning {

// Address of mj_geomDistance in the library that Python has loaded.
using GeomDistance = double (*)(const mjModel_*, mjData_*, int, int, double, double*);
extern GeomDistance geom_distance;

class NarrowPhase {
 public:
  // Model of `physics.compile.shape_pair`: geoms 0, 1 primitives and 2, 3 meshes; not shared with other threads.
  NarrowPhase(mjModel_* model, mjData_* data);

  // Signed distance [m], at most `cutoff`; below zero: depth. Points on both shapes, if wanted and nearer than
  // `cutoff`.
  double distance(const ConvexShape& a, const Rigid& pose_a, const ConvexShape& b, const Rigid& pose_b, double cutoff,
                  Vec3* on_a = nullptr, Vec3* on_b = nullptr);

  // True if the shapes are at least `margin` > 0, or any distance if it is 0, apart.
  bool is_apart(const ConvexShape& a, const Rigid& pose_a, const ConvexShape& b, const Rigid& pose_b, double margin);

  std::size_t capacity() const { return capacity_; }  // greatest number of corners of a hull

 private:
  int place(int side, const ConvexShape& shape, const Rigid& pose);

  mjModel_* model_;
  mjData_* data_;
  std::size_t capacity_;
  std::array<std::uint64_t, 2> held_{};  // shape whose corners each mesh has
};

// Distance of a shape from a thin plane through `pose` with normal z; below zero: the plane cuts it.
double plane_distance(const Rigid& plane, const ConvexShape& shape, const Rigid& pose, Vec3* on_plane, Vec3* on_shape);

}  // namespace trundle::planning
