#include "graph_slam_bindings.h"

#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/tuple.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include "graph_slam.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace trundle::navigation {

namespace {

template <typename Number, int columns>
using Rows = nb::ndarray<const Number, nb::shape<-1, columns>, nb::c_contig, nb::device::cpu>;
using Counts = nb::ndarray<const std::int64_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Cells = nb::ndarray<nb::numpy, std::int8_t, nb::ndim<2>>;
using Table = nb::ndarray<nb::numpy, double, nb::ndim<2>>;
using Numbers = nb::ndarray<nb::numpy, std::int64_t, nb::ndim<1>>;
using Triple3 = std::tuple<double, double, double>;
using Pair = std::tuple<double, double>;

constexpr std::int64_t kMaxCells = 400'000'000;
constexpr std::size_t kConstraintColumns = 11;

// A NumPy array that owns its values, row by row.
template <typename Number, typename Array, std::size_t dimensions>
Array owned(std::vector<Number> values, const std::array<std::size_t, dimensions>& shape) {
  auto kept = std::make_unique<std::vector<Number>>(std::move(values));
  Number* data = kept->data();
  nb::capsule owner(kept.release(), [](void* pointer) noexcept { delete static_cast<std::vector<Number>*>(pointer); });
  return Array(data, dimensions, shape.data(), owner);
}

Table table(std::vector<double> values, std::size_t columns) {
  const std::array<std::size_t, 2> shape{values.size() / columns, columns};
  return owned<double, Table>(std::move(values), shape);
}

PlanarPose pose_of(const Triple3& pose) {
  const auto [x, y, yaw] = pose;
  if (!std::isfinite(x + y + yaw)) throw nb::value_error("a pose is finite");
  return {x, y, yaw};
}

std::vector<Point> points_of(const Rows<double, 2>& rows, std::size_t first, std::size_t last) {
  std::vector<Point> points;
  points.reserve(last - first);
  for (std::size_t i = first; i < last; ++i)
    if (std::isfinite(rows(i, 0) + rows(i, 1))) points.push_back({rows(i, 0), rows(i, 1)});
  return points;
}

void make_slam(GraphSlam* self, const GraphOptions& options) {
  for (const double length : {options.resolution, options.window_resolution, options.loop_window_resolution})
    if (!(length > 0.0)) throw nb::value_error("resolutions are positive");
  new (self) GraphSlam(options);
}

bool process(GraphSlam& slam, const Triple3& motion, double time_s, const Pair& origin, const Rows<double, 2>& hits,
             const Rows<double, 2>& misses) {
  const PlanarPose moved = pose_of(motion);
  const auto [x, y] = origin;
  if (!std::isfinite(x + y + time_s)) throw nb::value_error("the origin and the time of a scan are finite");
  RangeScan scan{{x, y}, points_of(hits, 0, hits.shape(0)), {}, points_of(misses, 0, misses.shape(0))};
  const nb::gil_scoped_release release;
  find_normals(scan);
  return slam.process(moved, time_s, std::move(scan));
}

Cells draw(GraphSlam& slam, int first_column, int first_row, int width, int height, double occupied_threshold) {
  if (width < 0 || height < 0 || std::int64_t{width} * height > kMaxCells)
    throw nb::value_error("a map has at most 400 million cells");
  std::vector<std::int8_t> cells;
  {
    const nb::gil_scoped_release release;
    cells = slam.draw({first_column, first_row, width, height, occupied_threshold});
  }
  const std::array<std::size_t, 2> shape{static_cast<std::size_t>(height), static_cast<std::size_t>(width)};
  return owned<std::int8_t, Cells>(std::move(cells), shape);
}

std::tuple<int, int, int, int> seen(GraphSlam& slam) {
  const SeenCells cells = slam.seen();
  return {cells.first_column, cells.first_row, cells.last_column, cells.last_row};
}

Table poses(const GraphSlam& slam) {
  std::vector<double> values;
  for (const PlanarPose& pose : slam.graph().poses) values.insert(values.end(), {pose.x, pose.y, pose.yaw});
  return table(std::move(values), 3);
}

Table constraints(const GraphSlam& slam) {
  std::vector<double> values;
  for (const Constraint& constraint : slam.graph().constraints) {
    const auto& [from, to, motion, information] = constraint;
    values.insert(values.end(), {static_cast<double>(from), static_cast<double>(to), motion.x, motion.y, motion.yaw});
    values.insert(values.end(), information.begin(), information.end());
  }
  return table(std::move(values), kConstraintColumns);
}

// Origins, hits, the number of each scan's, misses, the number of each scan's.
std::tuple<Table, Table, Numbers, Table, Numbers> scans(const GraphSlam& slam) {
  std::vector<double> origins, hits, misses;
  std::vector<std::int64_t> hit_counts, miss_counts;
  for (const RangeScan& scan : slam.scans()) {
    origins.insert(origins.end(), {scan.origin.x, scan.origin.y});
    for (const Point& hit : scan.hits) hits.insert(hits.end(), {hit.x, hit.y});
    for (const Point& miss : scan.misses) misses.insert(misses.end(), {miss.x, miss.y});
    hit_counts.push_back(static_cast<std::int64_t>(scan.hits.size()));
    miss_counts.push_back(static_cast<std::int64_t>(scan.misses.size()));
  }
  const std::array<std::size_t, 1> count{hit_counts.size()};
  return {table(std::move(origins), 2), table(std::move(hits), 2), owned<std::int64_t, Numbers>(hit_counts, count),
          table(std::move(misses), 2), owned<std::int64_t, Numbers>(miss_counts, count)};
}

// Takes the next points of a table; refuses counts beyond its end.
class Taker {
 public:
  Taker(const Rows<double, 2>& rows, const Counts& counts) : rows_(rows), counts_(counts) {}

  std::vector<Point> take(std::size_t scan) {
    const std::int64_t count = counts_(scan);
    if (count < 0 || static_cast<std::size_t>(count) > rows_.shape(0) - next_)
      throw nb::value_error("the numbers of the scans' points do not fit the points");
    const std::size_t first = next_;
    next_ += static_cast<std::size_t>(count);
    return points_of(rows_, first, next_);
  }

 private:
  const Rows<double, 2>& rows_;
  const Counts& counts_;
  std::size_t next_ = 0;
};

PoseGraph graph_of(const Rows<double, 3>& poses, const Rows<double, 11>& rows) {
  PoseGraph graph;
  for (std::size_t i = 0; i < poses.shape(0); ++i)
    graph.poses.push_back(pose_of({poses(i, 0), poses(i, 1), poses(i, 2)}));
  const auto count = static_cast<double>(graph.poses.size());
  for (std::size_t i = 0; i < rows.shape(0); ++i) {
    double sum = 0.0;
    for (std::size_t k = 0; k < kConstraintColumns; ++k) sum += rows(i, k);
    const double from = rows(i, 0), to = rows(i, 1);
    if (!std::isfinite(sum) || !(from >= 0.0 && to >= 0.0 && from < count && to < count && from != to))
      throw nb::value_error("a constraint is not finite, or of nodes that are not there");
    graph.constraints.push_back({static_cast<int>(from),
                                 static_cast<int>(to),
                                 {rows(i, 2), rows(i, 3), rows(i, 4)},
                                 {rows(i, 5), rows(i, 6), rows(i, 7), rows(i, 8), rows(i, 9), rows(i, 10)}});
  }
  return graph;
}

void restore(GraphSlam& slam, const Rows<double, 3>& poses, const Rows<double, 11>& rows,
             const Rows<double, 2>& origins, const Rows<double, 2>& hits, const Counts& hit_counts,
             const Rows<double, 2>& misses, const Counts& miss_counts) {
  const std::size_t count = poses.shape(0);
  if (origins.shape(0) != count || hit_counts.shape(0) != count || miss_counts.shape(0) != count)
    throw nb::value_error("each node has a scan");
  Taker hit(hits, hit_counts), miss(misses, miss_counts);
  std::vector<RangeScan> scans;
  for (std::size_t i = 0; i < count; ++i) {
    if (!std::isfinite(origins(i, 0) + origins(i, 1))) throw nb::value_error("the origin of a scan is finite");
    scans.push_back({{origins(i, 0), origins(i, 1)}, hit.take(i), {}, miss.take(i)});
    find_normals(scans.back());
  }
  slam.restore(graph_of(poses, rows), std::move(scans));
}

}  // namespace

void bind_graph_slam(nb::module_& module) {
  nb::class_<SearchOptions>(module, "SearchOptions")
      .def(nb::init<>())
      .def_rw("half_width", &SearchOptions::half_width)
      .def_rw("half_angle", &SearchOptions::half_angle)
      .def_rw("angle_step", &SearchOptions::angle_step)
      .def_rw("fine_angle_step", &SearchOptions::fine_angle_step)
      .def_rw("is_penalized", &SearchOptions::is_penalized)
      .def_rw("distance_variance", &SearchOptions::distance_variance)
      .def_rw("angle_variance", &SearchOptions::angle_variance)
      .def_rw("least_distance_factor", &SearchOptions::least_distance_factor)
      .def_rw("least_angle_factor", &SearchOptions::least_angle_factor);
  nb::class_<GraphOptions>(module, "GraphOptions")
      .def(nb::init<>())
      .def_rw("resolution", &GraphOptions::resolution)
      .def_rw("least_distance", &GraphOptions::least_distance)
      .def_rw("least_angle", &GraphOptions::least_angle)
      .def_rw("least_time", &GraphOptions::least_time)
      .def_rw("longest_time", &GraphOptions::longest_time)
      .def_rw("matches_scans", &GraphOptions::matches_scans)
      .def_rw("matches_all", &GraphOptions::matches_all)
      .def_rw("uses_center", &GraphOptions::uses_center)
      .def_rw("running_scans", &GraphOptions::running_scans)
      .def_rw("running_distance", &GraphOptions::running_distance)
      .def_rw("link_distance", &GraphOptions::link_distance)
      .def_rw("link_response", &GraphOptions::link_response)
      .def_rw("closes_loops", &GraphOptions::closes_loops)
      .def_rw("loop_distance", &GraphOptions::loop_distance)
      .def_rw("loop_chain", &GraphOptions::loop_chain)
      .def_rw("loop_deviation", &GraphOptions::loop_deviation)
      .def_rw("loop_response_coarse", &GraphOptions::loop_response_coarse)
      .def_rw("loop_response_fine", &GraphOptions::loop_response_fine)
      .def_rw("window_resolution", &GraphOptions::window_resolution)
      .def_rw("window_smear", &GraphOptions::window_smear)
      .def_rw("search", &GraphOptions::search)
      .def_rw("loop_window_resolution", &GraphOptions::loop_window_resolution)
      .def_rw("loop_window_smear", &GraphOptions::loop_window_smear)
      .def_rw("loop_search", &GraphOptions::loop_search)
      .def_rw("linear_noise", &GraphOptions::linear_noise)
      .def_rw("angular_noise", &GraphOptions::angular_noise)
      .def_rw("turn_per_distance", &GraphOptions::turn_per_distance)
      .def_rw("still_linear_noise", &GraphOptions::still_linear_noise)
      .def_rw("still_angular_noise", &GraphOptions::still_angular_noise)
      .def_rw("extends_map", &GraphOptions::extends_map);
  nb::class_<GraphSlam>(module, "GraphSlam")
      .def("__init__", &make_slam, "options"_a)
      .def("process", &process, "motion"_a, "time_s"_a, "origin"_a, "hits"_a, "misses"_a)
      .def(
          "set_pose", [](GraphSlam& slam, const Triple3& pose) { slam.set_pose(pose_of(pose)); }, "pose"_a)
      .def("seen", &seen, nb::call_guard<nb::gil_scoped_release>())
      .def("draw", &draw, nb::kw_only(), "first_column"_a, "first_row"_a, "width"_a, "height"_a, "occupied_threshold"_a)
      .def("poses", &poses)
      .def("constraints", &constraints)
      .def("scans", &scans)
      .def("restore", &restore, "poses"_a, "constraints"_a, "origins"_a, "hits"_a, "hit_counts"_a, "misses"_a,
           "miss_counts"_a)
      .def_prop_ro("pose",
                   [](const GraphSlam& slam) {
                     const PlanarPose& pose = slam.pose();
                     return Triple3{pose.x, pose.y, pose.yaw};
                   })
      .def_prop_ro("correction",
                   [](const GraphSlam& slam) {
                     const PlanarPose& pose = slam.correction();
                     return Triple3{pose.x, pose.y, pose.yaw};
                   })
      .def_prop_ro("covariance", &GraphSlam::covariance)
      .def_prop_ro("response", &GraphSlam::response)
      .def_prop_ro("loops", &GraphSlam::loops)
      .def_prop_ro("refused_loops", &GraphSlam::refused_loops);
}

}  // namespace trundle::navigation
