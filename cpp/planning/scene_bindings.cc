#include "scene_bindings.h"

#include <nanobind/ndarray.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "array_cast.h"
#include "tree_kinematics.h"

namespace trundle::planning {

namespace {

using namespace nb::literals;
using Mask = nb::ndarray<const bool, nb::numpy, nb::ndim<1>, nb::c_contig, nb::device::cpu>;
using Faces = nb::ndarray<const std::int32_t, nb::numpy, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using Triple = std::tuple<double, double, double>;

double length_of(double value) {
  if (!(value >= 0.0 && value < 1e6)) throw nb::value_error("a length is finite and not negative");
  return value;
}

CollisionShape single(ConvexShape shape) { return {{std::make_shared<ConvexShape>(std::move(shape))}}; }

ConvexShape box(double x, double y, double z) {
  return make_primitive(ShapeKind::kBox, {0.5 * length_of(x), 0.5 * length_of(y), 0.5 * length_of(z)});
}

CollisionShape box_shape(double x, double y, double z) { return single(box(x, y, z)); }

CollisionShape sphere_shape(double radius) {
  return single(make_primitive(ShapeKind::kSphere, {length_of(radius), 0.0, 0.0}));
}

CollisionShape cylinder_shape(double radius, double length) {
  return single(make_primitive(ShapeKind::kCylinder, {length_of(radius), 0.5 * length_of(length), 0.0}));
}

CollisionShape plane_shape() { return single(make_primitive(ShapeKind::kPlane, {})); }

CollisionShape hull_shape(const Rows<3>& corners) {
  const std::vector<double> numbers(corners.data(), corners.data() + corners.size());
  for (const double number : numbers)
    if (!(std::abs(number) < 1e6)) throw nb::value_error("a corner has finite numbers");
  return single(make_hull(numbers));
}

CollisionShape surface_shape(const Rows<3>& vertices, const Faces& faces) {
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (!(std::abs(vertices.data()[i]) < 1e6)) throw nb::value_error("a vertex has finite numbers");
  CollisionShape surface;
  surface.parts.reserve(faces.shape(0));
  std::vector<double> corners(9);
  for (std::size_t i = 0; i < faces.shape(0); ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t vertex = faces(i, k);
      if (vertex < 0 || static_cast<std::size_t>(vertex) >= vertices.shape(0))
        throw nb::value_error("a face names a vertex that there is not");
      std::copy_n(vertices.data() + 3 * vertex, 3, corners.data() + 3 * k);
    }
    surface.parts.push_back(std::make_shared<ConvexShape>(make_hull(corners)));
  }
  return surface;
}

NarrowPhase narrow_phase(std::uintptr_t model, std::uintptr_t data) {
  if (geom_distance == nullptr) throw nb::value_error("MuJoCo's functions are not bound");
  return {reinterpret_cast<mjModel_*>(model), reinterpret_cast<mjData_*>(data)};
}

// Mask of links, or none.
class MaskOf {
 public:
  MaskOf(const Mask& links, std::size_t count) {
    if (links.size() == 0) return;
    if (links.size() != count) throw nb::value_error("a mask has one flag for each link");
    mask_.assign(links.data(), links.data() + links.size());
  }
  const LinkMask* get() const { return mask_.empty() ? nullptr : &mask_; }

 private:
  LinkMask mask_;
};

// The frame's pose is in the link's or the model frame, the shapes' poses are in the frame.
void set_body(SharedWorld& shared, int number, int link, double padding, const std::vector<CollisionShape>& shapes,
              const Rows<7>& rows, const Rows<7>& frame) {
  const std::vector<Rigid> poses = poses_of(rows), frames = poses_of(frame);
  if (poses.size() != shapes.size() || frames.size() != 1) throw nb::value_error("each shape has a pose");
  if (link >= static_cast<int>(shared.world.tree().size())) throw nb::value_error("no such link");
  Body body{link, padding, {}};
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const Rigid pose = frames[0] * poses[i];
    for (const auto& part : shapes[i].parts) body.pieces.push_back({part, pose});
  }
  const nb::gil_scoped_release unlocked;
  const std::scoped_lock lock(shared.mutex);
  shared.world.set_body(number, std::move(body));
}

// Cubes of some sizes, in a frame.
void set_voxels(SharedWorld& shared, int number, double padding, const Rows<3>& centers, const Numbers& sizes,
                const Rows<7>& frame) {
  const std::vector<Rigid> poses = poses_of(frame);
  if (sizes.size() != centers.shape(0) || poses.size() != 1) throw nb::value_error("each voxel has a size");
  std::map<double, std::shared_ptr<const ConvexShape>> cubes;
  Body body{-1, padding, {}};
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    auto& cube = cubes[sizes.data()[i]];
    if (!cube) cube = std::make_shared<ConvexShape>(box(sizes.data()[i], sizes.data()[i], sizes.data()[i]));
    for (std::size_t k = 0; k < 3; ++k)
      if (!(std::abs(centers(i, k)) < 1e6)) throw nb::value_error("a voxel's center has finite numbers");
    body.pieces.push_back({cube, {poses[0].r, poses[0] * Vec3{centers(i, 0), centers(i, 1), centers(i, 2)}}});
  }
  const nb::gil_scoped_release unlocked;
  const std::scoped_lock lock(shared.mutex);
  shared.world.set_body(number, std::move(body));
}

Triple triple(const Vec3& v) { return {v.x, v.y, v.z}; }

using ContactRow = std::tuple<int, int, double, Triple, Triple>;

std::vector<ContactRow> contacts(SharedWorld& shared, const Numbers& state, const Mask& links, std::size_t max_count,
                                 std::size_t max_per_pair) {
  const MaskOf mask(links, shared.world.tree().size());
  const std::span<const double> numbers = span_of(state, shared.variables);
  std::vector<BodyContact> found;
  {
    const nb::gil_scoped_release unlocked;
    const std::scoped_lock lock(shared.mutex);
    found = shared.world.contacts(numbers, mask.get(), max_count, max_per_pair);
  }
  std::vector<ContactRow> rows;
  for (const BodyContact& contact : found)
    rows.emplace_back(contact.a, contact.b, contact.depth, triple(contact.position), triple(contact.normal));
  return rows;
}

bool is_free(SharedWorld& shared, const Numbers& state, const Mask& links) {
  const MaskOf mask(links, shared.world.tree().size());
  const std::span<const double> numbers = span_of(state, shared.variables);
  const nb::gil_scoped_release unlocked;
  const std::scoped_lock lock(shared.mutex);
  return shared.world.is_free(numbers, mask.get());
}

std::tuple<double, int, int, Triple, Triple> nearest(SharedWorld& shared, const Numbers& state, const Mask& links,
                                                     double cutoff) {
  const MaskOf mask(links, shared.world.tree().size());
  const std::span<const double> numbers = span_of(state, shared.variables);
  NearestBodies found;
  {
    const nb::gil_scoped_release unlocked;
    const std::scoped_lock lock(shared.mutex);
    found = shared.world.nearest(numbers, mask.get(), cutoff);
  }
  return {found.distance, found.a, found.b, triple(found.on_a), triple(found.on_b)};
}

std::shared_ptr<SharedWorld> copy(SharedWorld& shared, std::uintptr_t model, std::uintptr_t data) {
  const NarrowPhase narrow = narrow_phase(model, data);
  const nb::gil_scoped_release unlocked;
  const std::scoped_lock lock(shared.mutex);
  return std::make_shared<SharedWorld>(shared.world.copy(narrow), shared.variables);
}

// Valid states are those without collision, of the links of a group.
class CollisionCheck final : public StateCheck {
 public:
  CollisionCheck(std::shared_ptr<SharedWorld> shared, const Mask& links)
      : shared_(std::move(shared)), mask_(links, shared_->world.tree().size()) {}

  bool is_valid(const double* state) override {
    const std::scoped_lock lock(shared_->mutex);
    return shared_->world.is_free({state, shared_->variables}, mask_.get());
  }

 private:
  std::shared_ptr<SharedWorld> shared_;
  MaskOf mask_;
};

}  // namespace

void bind_scene(nb::module_& module) {
  module.def(
      "bind_distance", [](std::uintptr_t address) { geom_distance = reinterpret_cast<GeomDistance>(address); },
      "address"_a);
  nb::class_<CollisionShape>(module, "CollisionShape").def_prop_ro("size", [](const CollisionShape& self) {
    return self.parts.size();
  });
  module.def("box_shape", box_shape, "x"_a, "y"_a, "z"_a);
  module.def("sphere_shape", sphere_shape, "radius"_a);
  module.def("cylinder_shape", cylinder_shape, "radius"_a, "length"_a);
  module.def("plane_shape", plane_shape);
  module.def("hull_shape", hull_shape, "corners"_a);
  module.def("surface_shape", surface_shape, "vertices"_a, "faces"_a);
  nb::class_<SharedWorld>(module, "CollisionWorld")
      .def(
          "__init__",
          [](SharedWorld* self, const TreeKinematics& kinematics, std::uintptr_t model, std::uintptr_t data) {
            new (self)
                SharedWorld(CollisionWorld(kinematics.tree(), narrow_phase(model, data)), kinematics.variables());
          },
          "kinematics"_a, "model"_a, "data"_a)
      .def("copy", copy, "model"_a, "data"_a)
      .def("set_body", set_body, "number"_a, "link"_a, "padding"_a, "shapes"_a, "poses"_a, "frame"_a)
      .def("set_voxels", set_voxels, "number"_a, "padding"_a, "centers"_a, "sizes"_a, "frame"_a)
      .def(
          "remove_body",
          [](SharedWorld& shared, int number) {
            const nb::gil_scoped_release unlocked;
            const std::scoped_lock lock(shared.mutex);
            shared.world.remove_body(number);
          },
          "number"_a)
      .def(
          "allow",
          [](SharedWorld& shared, int a, int b, bool is_allowed) {
            const nb::gil_scoped_release unlocked;
            const std::scoped_lock lock(shared.mutex);
            shared.world.allow(a, b, is_allowed);
          },
          "a"_a, "b"_a, "is_allowed"_a)
      .def("is_free", is_free, "state"_a, "links"_a)
      .def("contacts", contacts, "state"_a, "links"_a, "max_count"_a, "max_per_pair"_a)
      .def("nearest", nearest, "state"_a, "links"_a, "cutoff"_a);
  nb::class_<CollisionCheck, StateCheck>(module, "CollisionCheck")
      .def(nb::init<std::shared_ptr<SharedWorld>, const Mask&>(), "world"_a, "links"_a);
}

}  // namespace trundle::planning
