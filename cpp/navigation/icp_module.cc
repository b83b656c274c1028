// The Python module `_icp`: motion between two scans.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/tuple.h>

#include <cmath>
#include <tuple>
#include <vector>

#include "point_to_line_icp.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace trundle::navigation {

namespace {

using Points = nb::ndarray<const double, nb::shape<-1, 2>, nb::c_contig, nb::device::cpu>;
using Tuple = std::tuple<double, double, double>;

constexpr double kFarthest = 1e6;  // [m]

std::vector<ScanPoint> points_of(const Points& array) {
  std::vector<ScanPoint> points;
  points.reserve(array.shape(0));
  for (std::size_t i = 0; i < array.shape(0); ++i)
    if (std::abs(array(i, 0)) < kFarthest && std::abs(array(i, 1)) < kFarthest)
      points.push_back({array(i, 0), array(i, 1)});
  return points;
}

IcpMatch match(const IcpOptions& options, const Points& reference, const Points& scan, const Tuple& guess) {
  const auto [x, y, yaw] = guess;
  if (!(std::abs(x) < kFarthest && std::abs(y) < kFarthest && std::isfinite(yaw)))
    throw nb::value_error("the guess is finite");
  if (!(options.max_correspondence > 0.0)) throw nb::value_error("max_correspondence is positive");
  const std::vector<ScanPoint> from = points_of(reference), to = points_of(scan);
  const nb::gil_scoped_release release;
  return match_scans(from, to, {x, y, yaw}, options);
}

}  // namespace

NB_MODULE(_icp, module) {
  nb::class_<IcpOptions>(module, "IcpOptions")
      .def(nb::init<>())
      .def_rw("max_iterations", &IcpOptions::max_iterations)
      .def_rw("epsilon_xy", &IcpOptions::epsilon_xy)
      .def_rw("epsilon_theta", &IcpOptions::epsilon_theta)
      .def_rw("max_correspondence", &IcpOptions::max_correspondence)
      .def_rw("max_linear", &IcpOptions::max_linear)
      .def_rw("max_angular", &IcpOptions::max_angular)
      .def_rw("max_ratio", &IcpOptions::max_ratio)
      .def_rw("adaptive_order", &IcpOptions::adaptive_order)
      .def_rw("adaptive_multiple", &IcpOptions::adaptive_multiple)
      .def_rw("sigma", &IcpOptions::sigma)
      .def_rw("uses_lines", &IcpOptions::uses_lines);
  nb::class_<IcpMatch>(module, "IcpMatch")
      .def_ro("is_valid", &IcpMatch::is_valid)
      .def_prop_ro("pose", [](const IcpMatch& match) { return Tuple{match.pose.x, match.pose.y, match.pose.yaw}; })
      .def_ro("error", &IcpMatch::error)
      .def_ro("count", &IcpMatch::count)
      .def_ro("covariance", &IcpMatch::covariance);
  module.def("match_scans", &match, "options"_a, "reference"_a, "scan"_a, "guess"_a);
}

}  // namespace trundle::navigation
