// The Python module `_meshes`: loops over the faces of meshes. None holds the GIL.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <utility>

#include "mesh_edges.h"
#include "support_graph.h"
#include "unique_rows.h"

namespace nb = nanobind;
using namespace nb::literals;

namespace trundle {

namespace {

template <typename Number>
using Triples = nb::ndarray<const Number, nb::numpy, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using Indices = nb::ndarray<const std::int64_t, nb::numpy, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using NoGil = nb::gil_scoped_release;

template <typename Number>
nb::object array_of(std::vector<Number> numbers) {
  auto* kept = new std::vector<Number>(std::move(numbers));
  const nb::capsule owner(kept, [](void* data) noexcept { delete static_cast<std::vector<Number>*>(data); });
  const std::size_t size = kept->size();
  return nb::cast(nb::ndarray<nb::numpy, Number>(kept->data(), 1, &size, owner));
}

template <typename Number>
nb::tuple unique_rows_of(const Triples<Number>& rows) {
  UniqueRows unique;
  {
    const NoGil unlocked;
    unique = unique_rows(rows.data(), rows.shape(0));
  }
  return nb::make_tuple(array_of(std::move(unique.first)), array_of(std::move(unique.number)));
}

MeshView view_of(const double* points, std::size_t point_count, const Triples<std::int64_t>& faces) {
  for (std::size_t i = 0; i < 3 * faces.shape(0); ++i) {
    const std::int64_t point = faces.data()[i];
    if (point < 0 || point >= static_cast<std::int64_t>(point_count))
      throw nb::index_error("a face names a point that is not there");
  }
  return {points, point_count, faces.data(), faces.shape(0)};
}

MeshView view_of(const Triples<double>& points, const Triples<std::int64_t>& faces) {
  return view_of(points.data(), points.shape(0), faces);
}

template <typename Function>
auto unlocked(Function function) {
  const NoGil no_gil;
  return function();
}

nb::object climbed(const SupportGraph& graph, const Triples<double>& directions, const Indices& starts) {
  if (directions.shape(0) != starts.shape(0)) throw nb::value_error("a start for each direction");
  std::vector<std::int64_t> tops(starts.shape(0));
  for (std::size_t i = 0; i < tops.size(); ++i)
    if (starts(i) < 0 || starts(i) >= static_cast<std::int64_t>(graph.size())) throw nb::index_error("no such start");
  unlocked([&] {
    for (std::size_t i = 0; i < tops.size(); ++i)
      tops[i] = graph.climb(vector_at(directions.data() + 3 * i), starts(i));
    return 0;
  });
  return array_of(std::move(tops));
}

}  // namespace

NB_MODULE(_meshes, module) {
  module.def("unique_rows", &unique_rows_of<float>, "rows"_a.noconvert());
  module.def("unique_rows", &unique_rows_of<double>, "rows"_a.noconvert());
  module.def(
      "component_labels",
      [](std::size_t count, const Triples<std::int64_t>& faces) {
        const MeshView mesh = view_of(nullptr, count, faces);
        return array_of(unlocked([&] { return component_labels(mesh); }));
      },
      "count"_a, "faces"_a);
  module.def(
      "double_areas",
      [](const Triples<double>& points, const Triples<std::int64_t>& faces) {
        const MeshView mesh = view_of(points, faces);
        return array_of(unlocked([&] { return double_areas(mesh); }));
      },
      "points"_a, "faces"_a);
  module.def(
      "fold_height",
      [](const Triples<double>& points, const Triples<std::int64_t>& faces) -> nb::object {
        const MeshView mesh = view_of(points, faces);
        bool is_closed = false;
        const double height = unlocked([&] {
          const std::vector<std::int64_t> sides = sides_by_edge(mesh);
          is_closed = !sides.empty();
          return is_closed ? fold_height(mesh, sides) : 0.0;
        });
        return is_closed ? nb::cast(height) : nb::none();
      },
      "points"_a, "faces"_a);
  nb::class_<SupportGraph>(module, "SupportGraph")
      .def(
          "__init__",
          [](SupportGraph* self, const Triples<double>& points, const Triples<std::int64_t>& faces) {
            new (self) SupportGraph(view_of(points, faces));
          },
          "points"_a, "faces"_a)
      .def("climb", &climbed, "directions"_a, "starts"_a);
}

}  // namespace trundle
