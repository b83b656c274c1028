// The Python module `_octomaps`: occupancy of cubes in space.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/tuple.h>

#include <cmath>
#include <memory>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "occupancy_tree.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace trundle::navigation {

namespace {

using Points = nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using Bytes = nb::ndarray<const std::uint8_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

template <typename Value, typename Array>
Array owned(std::vector<Value> values, std::initializer_list<std::size_t> shape) {
  auto kept = std::make_unique<std::vector<Value>>(std::move(values));
  Value* data = kept->data();
  nb::capsule owner(kept.release(), [](void* pointer) noexcept { delete static_cast<std::vector<Value>*>(pointer); });
  return Array(data, shape, owner);
}

using Stream = nb::ndarray<nb::numpy, std::uint8_t, nb::ndim<1>>;
using Cells = nb::ndarray<nb::numpy, std::int8_t, nb::ndim<2>>;
using Cubes = nb::ndarray<nb::numpy, int, nb::ndim<2>>;

Stream stream_of(std::vector<std::uint8_t> data) {
  const std::size_t size = data.size();
  return owned<std::uint8_t, Stream>(std::move(data), {size});
}

std::span<const Point> points_of(const Points& array) {
  return {reinterpret_cast<const Point*>(array.data()), array.shape(0)};
}

void make_tree(OccupancyTree* self, double resolution, float hit, float miss, float lower, float upper) {
  if (!(resolution > 0.0 && std::isfinite(resolution))) throw nb::value_error("the resolution is positive");
  if (!(hit > 0.0F && miss < 0.0F && lower < 0.0F && upper > 0.0F)) throw nb::value_error("log-odds have their signs");
  new (self) OccupancyTree(TreeOptions{resolution, hit, miss, lower, upper});
}

bool insert(OccupancyTree& tree, const Point& origin, const Points& hits, const Points& floor, double max_range) {
  const std::span<const Point> ends = points_of(hits), grounds = points_of(floor);
  const nb::gil_scoped_release release;
  return tree.insert(origin, ends, grounds, max_range);
}

Stream binary(const OccupancyTree& tree) {
  std::vector<std::uint8_t> data;
  {
    const nb::gil_scoped_release release;
    data = tree.binary();
  }
  return stream_of(std::move(data));
}

Stream full(const OccupancyTree& tree) {
  std::vector<std::uint8_t> data;
  {
    const nb::gil_scoped_release release;
    data = tree.full();
  }
  return stream_of(std::move(data));
}

bool read(OccupancyTree& tree, const Bytes& bytes, bool is_binary, std::size_t node_size) {
  const std::span<const std::uint8_t> data{bytes.data(), bytes.size()};
  const nb::gil_scoped_release release;
  return is_binary ? tree.read_binary(data) : tree.read_full(data, node_size);
}

Cubes leaves(const OccupancyTree& tree, bool occupied) {
  std::vector<int> rows;
  {
    const nb::gil_scoped_release release;
    for (const TreeLeaf& leaf : tree.leaves(occupied ? CubeKind::kOccupied : CubeKind::kFree))
      rows.insert(rows.end(), {leaf.x, leaf.y, leaf.z, leaf.depth});
  }
  const std::size_t count = rows.size() / 4;
  return owned<int, Cubes>(std::move(rows), {count, 4});
}

std::tuple<int, int, Cells> project(const OccupancyTree& tree, double low, double high) {
  Projection found;
  {
    const nb::gil_scoped_release release;
    found = tree.project(low, high);
  }
  const auto height = static_cast<std::size_t>(found.height), width = static_cast<std::size_t>(found.width);
  return {found.x, found.y, owned<std::int8_t, Cells>(std::move(found.cells), {height, width})};
}

}  // namespace

NB_MODULE(_octomaps, module) {
  nb::class_<OccupancyTree>(module, "OccupancyTree")
      .def("__init__", &make_tree, "resolution"_a, nb::kw_only(), "hit"_a, "miss"_a, "lower"_a, "upper"_a)
      .def("insert", &insert, "origin"_a, "hits"_a, "floor"_a, nb::kw_only(), "max_range"_a)
      .def("clear_box", &OccupancyTree::clear_box, "low"_a, "high"_a, nb::call_guard<nb::gil_scoped_release>())
      .def("reset", &OccupancyTree::reset)
      .def("binary", &binary)
      .def("full", &full)
      .def("read", &read, "data"_a, nb::kw_only(), "binary"_a, "node_size"_a = 5)
      .def("leaves", &leaves, nb::kw_only(), "occupied"_a)
      .def("project", &project, "low"_a, "high"_a)
      .def("odds", &OccupancyTree::odds, "point"_a)
      .def_prop_ro("resolution", [](const OccupancyTree& tree) { return tree.options().resolution; })
      .def_prop_ro("is_empty", &OccupancyTree::is_empty);
}

}  // namespace trundle::navigation
