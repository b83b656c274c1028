#include "renderer.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>
#include <string_view>

namespace trundle {

const Kernel& best_kernel() {
  static const Kernel& chosen = []() -> const Kernel& {
#ifdef TRUNDLE_X86
    const char* wish = std::getenv("TRUNDLE_RENDER_ISA");  // to compare their bytes
    const std::string_view most = wish ? wish : "avx512";
    __builtin_cpu_init();
    const bool has_avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                            __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl");
    if (most == "avx512" && has_avx512) return avx512::kernel;
    if (most != "baseline" && __builtin_cpu_supports("avx2")) return avx2::kernel;
#endif
    return baseline::kernel;
  }();
  return chosen;
}

Triangles Mesh::triangles() const {
  return {vertices.data(), faces.data(), normals.data(), (int32_t)(vertices.size() / 3), (int32_t)(faces.size() / 3)};
}

Mesh make_mesh(std::vector<float> vertices, std::vector<int32_t> faces) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  Mesh mesh{std::move(vertices), {}, {}, {inf, inf, inf}, {-inf, -inf, -inf}};
  const auto count = (int32_t)(mesh.vertices.size() / 3);
  for (size_t i = 0; i + 2 < faces.size(); i += 3) {
    double p[3][3];
    for (int corner = 0; corner < 3; ++corner) {
      const int32_t vertex = faces[i + corner];
      if (vertex < 0 || vertex >= count) throw std::invalid_argument("a face names a vertex that does not exist");
      for (int axis = 0; axis < 3; ++axis) p[corner][axis] = mesh.vertices[3 * (size_t)vertex + axis];
    }
    Vec3 a, b;
    for (int axis = 0; axis < 3; ++axis) a[axis] = p[1][axis] - p[0][axis], b[axis] = p[2][axis] - p[0][axis];
    const Vec3 n = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (!(length > 0.0) || !std::isfinite(length)) continue;
    for (int axis = 0; axis < 3; ++axis) {
      mesh.faces.push_back(faces[i + axis]);
      mesh.normals.push_back((float)(n[axis] / length));
      for (const auto& corner : p) {
        mesh.low[axis] = std::min(mesh.low[axis], corner[axis]);
        mesh.high[axis] = std::max(mesh.high[axis], corner[axis]);
      }
    }
  }
  return mesh;
}

namespace {

int32_t packed(const std::array<float, 3>& colour) {
  int32_t word = 0;
  for (int i = 0; i < 3; ++i)
    word |= (int32_t)(std::clamp(std::isfinite(colour[i]) ? colour[i] : 0.0f, 0.0f, 1.0f) * 255.0f + 0.5f) << (8 * i);
  return word;
}

bool is_finite(const std::array<float, 3>& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](float number) { return std::isfinite(number); });
}

}  // namespace

Renderer::Renderer(int32_t bodies, std::vector<Mesh> meshes, std::vector<ShapeSpec> shapes,
                   std::vector<LightSpec> lights, std::array<float, 3> ambient, std::array<float, 3> background)
    : meshes_(std::move(meshes)),
      shapes_(std::move(shapes)),
      lights_(std::move(lights)),
      ambient_(ambient),
      background_(packed(background)),
      body_poses_((size_t)bodies, Frame()) {
  size_t most = 0;
  for (const Mesh& mesh : meshes_) {
    triangles_.push_back(mesh.triangles());
    most = std::max(most, mesh.vertices.size() / 3);
  }
  projected_.resize(6 * most);
  int64_t id = 0;
  for (const ShapeSpec& shape : shapes_) {
    if (shape.body < 0 || shape.body >= bodies) throw std::invalid_argument("a shape rides on a body that does not exist");
    if (shape.kind == Kind::kMesh && (shape.mesh < 0 || (size_t)shape.mesh >= meshes_.size()))
      throw std::invalid_argument("a shape names a mesh that does not exist");
    first_ids_.push_back((int32_t)id);
    id += shape.kind == Kind::kMesh ? triangles_[shape.mesh].face_count : 1;
    if (id > std::numeric_limits<int32_t>::max()) throw std::invalid_argument("more than two billion triangles");
  }
}

void Renderer::update(const double* poses) {
  for (size_t i = 0; i < body_poses_.size(); ++i) body_poses_[i] = Frame::of(poses + 7 * i);
}

bool Renderer::place(const View& view, const Frame& world_from_camera, size_t index, Solid& solid) const {
  const ShapeSpec& shape = shapes_[index];
  const auto& body = body_poses_[shape.body];
  if (!body || !is_finite(shape.size)) return false;
  const Frame world_from_shape = *body * shape.body_from_shape;
  Frame camera_from_shape;
  for (int i = 0; i < 3; ++i) {
    const Vec3 axis = world_from_camera.turn_back(world_from_shape.axis(i));
    for (int row = 0; row < 3; ++row) {
      camera_from_shape.rotation[3 * row + i] = axis[row];
      solid.axes[3 * i + row] = (float)axis[row];
    }
  }
  camera_from_shape.position = world_from_camera.move_back(world_from_shape.position);
  const Vec3 eye = world_from_shape.move_back(world_from_camera.position);
  for (int i = 0; i < 3; ++i) {
    solid.eye[i] = (float)eye[i];
    solid.centre[i] = (float)camera_from_shape.position[i];
    solid.size[i] = shape.size[i];
    solid.colour[i] = shape.colour[i];
    if (!std::isfinite(solid.eye[i]) || !std::isfinite(solid.centre[i])) return false;
  }
  solid.kind = shape.kind;
  solid.first_id = first_ids_[index];
  solid.index = (int32_t)index;
  solid.id_count = 1;
  solid.mesh = nullptr;
  const double x = shape.size[0], y = shape.size[1], z = shape.size[2];
  Vec3 low, high;
  switch (shape.kind) {
    case Kind::kPlane: {
      const double endless = 1e6;
      high = {x > 0 ? x : endless, y > 0 ? y : endless, 0.0};
      if (!(x > 0 && y > 0)) {
        solid.left = solid.top = 0, solid.right = view.width, solid.bottom = view.height;
        return eye[2] > 0.0;
      }
      break;
    }
    case Kind::kSphere: high = {x, x, x}; break;
    case Kind::kCylinder: high = {x, x, y}; break;
    case Kind::kCapsule: high = {x, x, x + y}; break;
    case Kind::kBox:
    case Kind::kEllipsoid: high = {x, y, z}; break;
    case Kind::kMesh:
      solid.mesh = &triangles_[shape.mesh];
      solid.id_count = solid.mesh->face_count;
      if (solid.id_count == 0) return false;
      high = meshes_[shape.mesh].high;
      break;
  }
  low = shape.kind == Kind::kMesh ? meshes_[shape.mesh].low : Vec3{-high[0], -high[1], -high[2]};
  const Rectangle pixels = covered(view, camera_from_shape, low, high);
  solid.left = pixels.left, solid.top = pixels.top, solid.right = pixels.right, solid.bottom = pixels.bottom;
  return !pixels.empty();
}

void Renderer::render(const Camera& camera, uint8_t* rgb, float* depth, int32_t* segment) {
  const int32_t stride = (camera.width + kWidest - 1) / kWidest * kWidest;
  const View view{camera.width, camera.height, stride, camera.width * 0.5f, camera.height * 0.5f,
                  (float)camera.focal, (float)camera.near_, (float)camera.far_};
  const size_t count = (size_t)stride * (size_t)camera.height;
  nearness_.assign(count, 1.0f / view.far_);
  id_.assign(count, -1);
  colour_.assign(count, background_);
  if (segment) segment_.assign(count, -1);
  const Buffers buffers{nearness_.data(), id_.data(), colour_.data(), segment ? segment_.data() : nullptr,
                        projected_.data()};
  std::vector<Light> lamps;
  for (const LightSpec& light : lights_) {
    const Vec3 direction = camera.world_from_camera.turn_back(light.direction);
    lamps.push_back({{(float)-direction[0], (float)-direction[1], (float)-direction[2]},
                     {light.diffuse[0], light.diffuse[1], light.diffuse[2]}});
  }
  const Lighting lighting{{ambient_[0], ambient_[1], ambient_[2]}, lamps.data(), (int32_t)lamps.size()};
  std::vector<Solid> solids;
  for (size_t i = 0; i < shapes_.size(); ++i) {
    Solid solid;
    if (place(view, camera.world_from_camera, i, solid)) solids.push_back(solid);
  }
  const Kernel& kernel = best_kernel();
  for (const Solid& solid : solids) kernel.see(view, solid, buffers);
  for (const Solid& solid : solids) kernel.shade(view, solid, lighting, buffers);
  for (int32_t row = 0; row < camera.height; ++row) {
    const size_t from = (size_t)row * stride, to = (size_t)row * camera.width;
    for (int32_t column = 0; column < camera.width; ++column) {
      const int32_t word = colour_[from + column];
      uint8_t* pixel = rgb + 3 * (to + column);
      pixel[0] = (uint8_t)word, pixel[1] = (uint8_t)(word >> 8), pixel[2] = (uint8_t)(word >> 16);
    }
    if (depth)
      for (int32_t column = 0; column < camera.width; ++column)
        depth[to + column] = id_[from + column] < 0 ? std::numeric_limits<float>::infinity()
                                                    : 1.0f / nearness_[from + column];
    if (segment) std::copy_n(segment_.data() + from, camera.width, segment + to);
  }
}

}  // namespace trundle
