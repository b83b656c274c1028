// The Python module `_native`; the only file of the renderer that includes nanobind.
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

using Color = std::array<float, 3>;

Transform transform_of(const std::array<double, 7>& pose, const char* owner) {
  const auto transform = Transform::from_pose(pose.data());
  if (!transform) throw std::invalid_argument(std::string("the pose of ") + owner + " is not finite");
  return *transform;
}

Sky sky_of(const Color& horizon, const Color& zenith) {
  return Sky{{horizon[0], horizon[1], horizon[2]}, {zenith[0], zenith[1], zenith[2]}, {}, 0};
}

}  // namespace

NB_MODULE(_native, module) {
  nb::set_leak_warnings(false);  // renderers alive at exit are freed with the process
  nb::enum_<ShapeKind>(module, "ShapeKind")
      .value("PLANE", ShapeKind::kPlane)
      .value("BOX", ShapeKind::kBox)
      .value("SPHERE", ShapeKind::kSphere)
      .value("CYLINDER", ShapeKind::kCylinder)
      .value("CAPSULE", ShapeKind::kCapsule)
      .value("ELLIPSOID", ShapeKind::kEllipsoid)
      .value("MESH", ShapeKind::kMesh);

  nb::enum_<LightKind>(module, "LightKind")
      .value("DIRECTIONAL", LightKind::kDirectional)
      .value("POINT", LightKind::kPoint)
      .value("SPOT", LightKind::kSpot);

  nb::enum_<FogKind>(module, "FogKind")
      .value("NONE", FogKind::kNone)
      .value("LINEAR", FogKind::kLinear)
      .value("EXPONENTIAL", FogKind::kExponential)
      .value("SQUARED", FogKind::kSquared);

  nb::class_<Mesh>(module, "Mesh")
      .def(
          "__init__",
          [](Mesh* self, Array<const float, nb::shape<-1, 3>> vertices, Array<const int32_t, nb::shape<-1, 3>> faces,
             std::optional<Array<const float, nb::shape<-1, 3, 2>>> uv,
             std::optional<Array<const float, nb::shape<-1, 3, 3>>> normals) {
            const auto numbers = [](const auto& array) {
              return array ? std::vector<float>(array->data(), array->data() + array->size()) : std::vector<float>();
            };
            new (self) Mesh(make_mesh({vertices.data(), vertices.data() + vertices.size()},
                                      {faces.data(), faces.data() + faces.size()}, numbers(uv), numbers(normals)));
          },
          nb::arg("vertices"), nb::arg("faces"), nb::kw_only(), nb::arg("uv") = nb::none(),
          nb::arg("normals") = nb::none());

  nb::class_<Image>(module, "Texture")
      .def(
          "__init__",
          [](Image* self, Array<const uint8_t, nb::shape<-1, -1, 3>> rgb) {
            if (rgb.shape(0) > 16384 || rgb.shape(1) > 16384)
              throw std::invalid_argument("a texture is 1 to 16384 pixels wide and high");
            new (self)
                Image(make_image(rgb.data(), static_cast<int32_t>(rgb.shape(1)), static_cast<int32_t>(rgb.shape(0))));
          },
          nb::arg("rgb"));

  nb::class_<MaterialSpec>(module, "Material")
      .def(
          "__init__",
          [](MaterialSpec* self, Color ambient, Color diffuse, Color specular, Color emissive, float shininess,
             float opacity, int32_t texture, std::array<float, 2> repeat) {
            new (self) MaterialSpec{ambient, diffuse, specular, emissive, shininess, opacity, texture, repeat};
          },
          nb::kw_only(), nb::arg("ambient"), nb::arg("diffuse"), nb::arg("specular"), nb::arg("emissive"),
          nb::arg("shininess"), nb::arg("opacity"), nb::arg("texture") = -1,
          nb::arg("repeat") = std::array<float, 2>{1, 1});

  nb::class_<ShapeSpec>(module, "Shape")
      .def(
          "__init__",
          [](ShapeSpec* self, ShapeKind kind, int32_t body, int32_t mesh, Vec3 size,
             std::array<double, 7> body_from_shape, MaterialSpec material, bool casts_shadow) {
            new (self)
                ShapeSpec{kind, body, mesh, size, transform_of(body_from_shape, "a shape"), material, casts_shadow};
          },
          nb::arg("kind"), nb::kw_only(), nb::arg("body"), nb::arg("mesh") = -1, nb::arg("size"),
          nb::arg("body_from_shape"), nb::arg("material"), nb::arg("casts_shadow") = true);

  nb::class_<LightSpec>(module, "Light")
      .def(
          "__init__",
          [](LightSpec* self, LightKind kind, int32_t body, Vec3 position, Vec3 direction, Color diffuse,
             Color specular, std::array<float, 3> attenuation, float range, float inner_angle, float outer_angle,
             float falloff, bool casts_shadows) {
            new (self)
                LightSpec{kind,           body,           position, direction,   diffuse,     specular, attenuation[0],
                          attenuation[1], attenuation[2], range,    inner_angle, outer_angle, falloff,  casts_shadows};
          },
          nb::arg("kind"), nb::kw_only(), nb::arg("body") = -1, nb::arg("position"), nb::arg("direction"),
          nb::arg("diffuse"), nb::arg("specular"), nb::arg("attenuation"), nb::arg("range"), nb::arg("inner_angle"),
          nb::arg("outer_angle"), nb::arg("falloff"), nb::arg("casts_shadows"));

  nb::class_<Fog>(module, "Fog")
      .def(
          "__init__",
          [](Fog* self, FogKind kind, Color color, float start, float end, float density) {
            new (self) Fog{kind, {color[0], color[1], color[2]}, start, end, density};
          },
          nb::arg("kind"), nb::kw_only(), nb::arg("color"), nb::arg("start"), nb::arg("end"), nb::arg("density"));

  nb::class_<Renderer> renderer(module, "Renderer");
  renderer
      .def(
          "__init__",
          [](Renderer* self, int32_t bodies, std::vector<Mesh> meshes, std::vector<Image> textures,
             std::vector<ShapeSpec> shapes, std::vector<LightSpec> lights, Color ambient, Color horizon, Color zenith,
             std::optional<Fog> fog, int32_t threads) {
            if (bodies < 0) throw std::invalid_argument("bodies must be at least 0");
            const Sky sky = sky_of(horizon, zenith);
            new (self) Renderer(SceneSpec{bodies, std::move(meshes), std::move(textures), std::move(shapes),
                                          std::move(lights), ambient, sky, fog.value_or(Fog{})},
                                threads);
          },
          nb::kw_only(), nb::arg("bodies"), nb::arg("meshes"), nb::arg("textures"), nb::arg("shapes"),
          nb::arg("lights"), nb::arg("ambient"), nb::arg("horizon"), nb::arg("zenith"), nb::arg("fog") = nb::none(),
          nb::arg("threads") = 1)
      .def(
          "update",
          [](Renderer& self, Array<const double, nb::shape<-1, 7>> poses) {
            if (poses.shape(0) != static_cast<size_t>(self.bodies()))
              throw std::invalid_argument("there must be one pose for each body");
            self.update(poses.data());
          },
          nb::arg("poses"))
      .def("set_mesh", &Renderer::set_mesh, nb::arg("index"), nb::arg("mesh"))
      .def("set_material", &Renderer::set_material, nb::arg("shape"), nb::arg("material"))
      .def(
          "set_lighting",
          [](Renderer& self, std::vector<LightSpec> lights, Color ambient, Color horizon, Color zenith) {
            self.set_lighting(std::move(lights), ambient, sky_of(horizon, zenith));
          },
          nb::arg("lights"), nb::kw_only(), nb::arg("ambient"), nb::arg("horizon"), nb::arg("zenith"))
      .def(
          "render",
          [](Renderer& self, const std::vector<std::array<double, 7>>& world_from_cameras,
             const std::vector<std::array<double, 3>>& lenses, Array<uint8_t, nb::shape<-1, -1, -1, 3>> rgb,
             std::optional<Array<float, nb::shape<-1, -1, -1>>> depth,
             std::optional<Array<int32_t, nb::shape<-1, -1, -1>>> segmentation) {
            const size_t count = world_from_cameras.size(), height = rgb.shape(1), width = rgb.shape(2);
            const auto fits = [&](const auto& array) {
              return array.shape(0) == count && array.shape(1) == height && array.shape(2) == width;
            };
            if (!fits(rgb) || (depth && !fits(*depth)) || (segmentation && !fits(*segmentation)))
              throw std::invalid_argument("all pictures must be of one size, and one for each camera");
            if (lenses.size() != count) throw std::invalid_argument("each camera must have a lens");
            if (height < 1 || width < 1 || height > 16384 || width > 16384)
              throw std::invalid_argument("a picture is 1 to 16384 pixels wide and high");
            std::vector<CameraTarget> targets;
            for (size_t i = 0; i < count; ++i) {
              const auto [focal, near_, far_] = lenses[i];
              if (!(near_ > 0.0 && far_ > near_ && focal > 0.0))
                throw std::invalid_argument("a camera needs 0 < near < far and a focal length above 0");
              const size_t first = i * height * width;
              targets.push_back({transform_of(world_from_cameras[i], "a camera"), static_cast<int32_t>(width),
                                 static_cast<int32_t>(height), focal, near_, far_, rgb.data() + 3 * first,
                                 depth ? depth->data() + first : nullptr,
                                 segmentation ? segmentation->data() + first : nullptr});
            }
            nb::gil_scoped_release unlocked;
            self.render(targets);
          },
          nb::arg("world_from_cameras"), nb::kw_only(), nb::arg("lenses"), nb::arg("rgb"),
          nb::arg("depth") = nb::none(), nb::arg("segmentation") = nb::none());

  renderer.def("cast_rays", [](Renderer& self, std::array<double, 7> world_from_origin,
                               Array<const double, nb::shape<-1, 3>> directions, double max_range, int32_t exclude,
                               Array<double, nb::shape<-1>> ranges, Array<int32_t, nb::shape<-1>> shapes) {
    const size_t count = directions.shape(0);
    if (ranges.shape(0) != count || shapes.shape(0) != count)
      throw std::invalid_argument("there must be one range and one shape for each direction");
    if (count > 100'000'000) throw std::invalid_argument("more than a hundred million rays");
    const Transform origin = transform_of(world_from_origin, "the origin of rays");
    nb::gil_scoped_release unlocked;
    self.cast_rays(origin, directions.data(), count, max_range, exclude, ranges.data(), shapes.data());
  });  // positional: looking up names takes a while

  const auto noise_of = [](uint64_t seed, float mean, float stddev) {
    return Noise{{static_cast<uint32_t>(seed), static_cast<uint32_t>(seed >> 32)}, mean, stddev};
  };
  module.def(
      "add_depth_noise",
      [noise_of](Array<float, nb::ndim<2>> depths, uint64_t seed, float mean, float stddev) {
        nb::gil_scoped_release unlocked;
        best_kernel().add_depth_noise(noise_of(seed, mean, stddev), static_cast<int64_t>(depths.size()), depths.data());
      },
      nb::arg("depths"), nb::kw_only(), nb::arg("seed"), nb::arg("mean"), nb::arg("stddev"));
  module.def(
      "add_color_noise",
      [noise_of](Array<uint8_t, nb::shape<-1, -1, 3>> rgb, uint64_t seed, float mean, float stddev) {
        nb::gil_scoped_release unlocked;
        best_kernel().add_color_noise(noise_of(seed, mean, stddev), static_cast<int64_t>(rgb.size()) / 3, rgb.data());
      },
      nb::arg("rgb"), nb::kw_only(), nb::arg("seed"), nb::arg("mean"), nb::arg("stddev"));
  module.def(
      "clip_depths",
      [](Array<const float, nb::ndim<2>> depths, float near, float far, Array<float, nb::ndim<2>> clipped) {
        if (clipped.size() != depths.size()) throw std::invalid_argument("both must be of one height and width");
        nb::gil_scoped_release unlocked;
        best_kernel().clip_depths(static_cast<int64_t>(depths.size()), near, far, depths.data(), clipped.data());
      },
      nb::arg("depths"), nb::kw_only(), nb::arg("near"), nb::arg("far"), nb::arg("clipped"));
  module.def(
      "fill_cloud",
      [](Array<float, nb::shape<-1, -1, 4>> points, Array<const float, nb::ndim<2>> depth,
         Array<const uint8_t, nb::shape<-1, -1, 3>> rgb, Array<const float, nb::ndim<2>> right,
         Array<const float, nb::ndim<2>> down) {
        const size_t count = depth.size();
        if (points.size() != 4 * count || rgb.size() != 3 * count || right.size() != count || down.size() != count)
          throw std::invalid_argument("all must be of one height and width");
        nb::gil_scoped_release unlocked;
        best_kernel().fill_cloud(static_cast<int64_t>(count), depth.data(), rgb.data(), right.data(), down.data(),
                                 points.data());
      },
      nb::arg("points"), nb::kw_only(), nb::arg("depth"), nb::arg("rgb"), nb::arg("right"), nb::arg("down"));

  module.def("instruction_set", [] { return best_kernel().name; }, "Name of the kernel in use.");
}
