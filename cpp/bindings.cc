// The Python module; the only file that knows nanobind.
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/vector.h>

#include "renderer.h"

namespace nb = nanobind;
using namespace trundle;

namespace {

template <typename Number, typename... Shape>
using Array = nb::ndarray<Number, nb::numpy, nb::c_contig, nb::device::cpu, Shape...>;

Frame frame_of(const std::array<double, 7>& pose, const char* whose) {
  const auto frame = Frame::of(pose.data());
  if (!frame) throw std::invalid_argument(std::string("the pose of ") + whose + " is not of finite numbers");
  return *frame;
}

}  // namespace

NB_MODULE(_native, module) {
  nb::enum_<Kind>(module, "Kind")
      .value("PLANE", Kind::kPlane)
      .value("BOX", Kind::kBox)
      .value("SPHERE", Kind::kSphere)
      .value("CYLINDER", Kind::kCylinder)
      .value("CAPSULE", Kind::kCapsule)
      .value("ELLIPSOID", Kind::kEllipsoid)
      .value("MESH", Kind::kMesh);

  nb::class_<Mesh>(module, "Mesh").def(
      "__init__",
      [](Mesh* self, Array<const float, nb::shape<-1, 3>> vertices, Array<const int32_t, nb::shape<-1, 3>> faces) {
        new (self) Mesh(make_mesh({vertices.data(), vertices.data() + vertices.size()},
                                  {faces.data(), faces.data() + faces.size()}));
      },
      nb::arg("vertices"), nb::arg("faces"));

  nb::class_<ShapeSpec>(module, "Shape")
      .def(
          "__init__",
          [](ShapeSpec* self, Kind kind, int32_t body, int32_t mesh, std::array<float, 3> size,
             std::array<double, 7> body_from_shape, std::array<float, 3> colour) {
            new (self) ShapeSpec{kind, body, mesh, size, frame_of(body_from_shape, "a shape"), colour};
          },
          nb::arg("kind"), nb::kw_only(), nb::arg("body"), nb::arg("mesh") = -1, nb::arg("size"),
          nb::arg("body_from_shape"), nb::arg("colour"));

  nb::class_<LightSpec>(module, "Light")
      .def(
          "__init__",
          [](LightSpec* self, std::array<double, 3> direction, std::array<float, 3> diffuse) {
            new (self) LightSpec{direction, diffuse};
          },
          nb::kw_only(), nb::arg("direction"), nb::arg("diffuse"));

  nb::class_<Renderer>(module, "Renderer")
      .def(nb::init<int32_t, std::vector<Mesh>, std::vector<ShapeSpec>, std::vector<LightSpec>, std::array<float, 3>,
                    std::array<float, 3>>(),
           nb::kw_only(), nb::arg("bodies"), nb::arg("meshes"), nb::arg("shapes"), nb::arg("lights"),
           nb::arg("ambient"), nb::arg("background"))
      .def(
          "update",
          [](Renderer& self, Array<const double, nb::shape<-1, 7>> poses) {
            if (poses.shape(0) != (size_t)self.bodies())
              throw std::invalid_argument("there must be one pose for each body");
            self.update(poses.data());
          },
          nb::arg("poses"))
      .def(
          "render",
          [](Renderer& self, std::array<double, 7> world_from_camera, double focal, double near_, double far_,
             Array<uint8_t, nb::shape<-1, -1, 3>> rgb, std::optional<Array<float, nb::shape<-1, -1>>> depth,
             std::optional<Array<int32_t, nb::shape<-1, -1>>> segmentation) {
            const size_t height = rgb.shape(0), width = rgb.shape(1);
            const auto fits = [&](const auto& array) { return array.shape(0) == height && array.shape(1) == width; };
            if ((depth && !fits(*depth)) || (segmentation && !fits(*segmentation)))
              throw std::invalid_argument("all pictures must be of one size");
            if (height < 1 || width < 1 || height > 16384 || width > 16384)
              throw std::invalid_argument("a picture is 1 to 16384 pixels wide and high");
            if (!(near_ > 0.0 && far_ > near_ && focal > 0.0))
              throw std::invalid_argument("a camera needs 0 < near < far and a focal length above 0");
            const Camera camera{frame_of(world_from_camera, "the camera"), (int32_t)width, (int32_t)height, focal,
                                near_, far_};
            float* depths = depth ? depth->data() : nullptr;
            int32_t* segments = segmentation ? segmentation->data() : nullptr;
            nb::gil_scoped_release unlocked;
            self.render(camera, rgb.data(), depths, segments);
          },
          nb::arg("world_from_camera"), nb::kw_only(), nb::arg("focal"), nb::arg("near"), nb::arg("far"),
          nb::arg("rgb"), nb::arg("depth") = nb::none(), nb::arg("segmentation") = nb::none());

  module.def("instruction_set", [] { return best_kernel().name; }, "Of the kernel that draws on this machine.");
}
