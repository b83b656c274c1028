#include "renderer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace trundle {

namespace {

constexpr double kEndless = 1e6;  // [m]

int32_t byte_of(double share) { return (int32_t)(std::isfinite(share) ? std::clamp(share, 0.0, 1.0) * 255.0 + 0.5 : 0); }

bool is_finite(const std::array<float, 3>& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](float number) { return std::isfinite(number); });
}

void copy(const std::array<float, 3>& from, float* to) { std::copy(from.begin(), from.end(), to); }

Look look_of(const LookSpec& spec, const std::vector<Image>& textures) {
  Look look{};
  copy(spec.ambient, look.ambient), copy(spec.diffuse, look.diffuse);
  copy(spec.specular, look.specular), copy(spec.emissive, look.emissive);
  look.shininess = std::isfinite(spec.shininess) ? std::clamp(spec.shininess, 0.0f, 1000.0f) : 0.0f;
  look.opacity = std::isfinite(spec.opacity) ? std::clamp(spec.opacity, 0.0f, 1.0f) : 1.0f;
  look.repeat[0] = spec.repeat[0], look.repeat[1] = spec.repeat[1];
  look.texture = spec.texture < 0 ? nullptr : &textures[spec.texture].texture;
  return look;
}

}  // namespace

Renderer::Renderer(SceneSpec scene)
    : scene_(std::move(scene)), body_poses_((size_t)scene_.bodies, Frame()), maps_(scene_.lights.size()) {
  size_t most = 0;
  for (const Mesh& mesh : scene_.meshes) {
    triangles_.push_back(mesh.triangles());
    most = std::max(most, mesh.places[0].size());
  }
  projected_.resize(6 * most);
  for (Image& image : scene_.textures) image.texture.texels = image.texels.data();
  const auto is_index = [](int32_t index, size_t count) { return index >= 0 && (size_t)index < count; };
  for (const ShapeSpec& shape : scene_.shapes) {
    if (!is_index(shape.body, (size_t)scene_.bodies))
      throw std::invalid_argument("a shape rides on a body that does not exist");
    if (shape.kind == Kind::kMesh && !is_index(shape.mesh, scene_.meshes.size()))
      throw std::invalid_argument("a shape names a mesh that does not exist");
    if (shape.look.texture != -1 && !is_index(shape.look.texture, scene_.textures.size()))
      throw std::invalid_argument("a shape names a texture that does not exist");
    looks_.push_back(look_of(shape.look, scene_.textures));
    if (shape.kind == Kind::kMesh && !triangles_[shape.mesh].layout) looks_.back().texture = nullptr;
  }
  for (const LightSpec& light : scene_.lights)
    if (light.body != -1 && !is_index(light.body, (size_t)scene_.bodies))
      throw std::invalid_argument("a light rides on a body that does not exist");
  number_faces();
  shape_poses_.resize(scene_.shapes.size());
  for (const ShapeSpec& shape : scene_.shapes) bounds_.push_back(bounds_of(shape));
  place_shapes();
}

void Renderer::update(const double* poses) {
  for (size_t i = 0; i < body_poses_.size(); ++i) {
    const auto pose = Frame::of(poses + 7 * i);
    const auto& before = body_poses_[i];
    maps_are_old_ |= pose.has_value() != before.has_value() ||
                     (pose && (pose->position != before->position || pose->rotation != before->rotation));
    body_poses_[i] = pose;
  }
  place_shapes();
}

void Renderer::place_shapes() {
  for (size_t i = 0; i < scene_.shapes.size(); ++i) {
    const ShapeSpec& shape = scene_.shapes[i];
    const auto& body = body_poses_[shape.body];
    shape_poses_[i] = body && is_finite(shape.size) ? std::optional(*body * shape.body_from_shape) : std::nullopt;
  }
}

void Renderer::reshape(int32_t mesh, Mesh form) {
  if (mesh < 0 || (size_t)mesh >= scene_.meshes.size()) throw std::invalid_argument("there is no such mesh");
  if (triangles_[mesh].layout && form.layout.empty() && form.face_count > 0)
    throw std::invalid_argument("a mesh cannot lose its places in textures");
  scene_.meshes[mesh] = std::move(form);
  triangles_[mesh] = scene_.meshes[mesh].triangles();
  projected_.resize(std::max(projected_.size(), 6 * scene_.meshes[mesh].places[0].size()));
  if (!trees_.empty()) trees_[mesh] = triangles_[mesh].face_count > 0 ? make_bvh(triangles_[mesh]) : Bvh();
  for (size_t i = 0; i < scene_.shapes.size(); ++i)
    if (scene_.shapes[i].kind == Kind::kMesh && scene_.shapes[i].mesh == mesh) bounds_[i] = bounds_of(scene_.shapes[i]);
  number_faces();
  maps_are_old_ = true;
}

// Each face of a mesh has a number of its own, any other shape has one.
void Renderer::number_faces() {
  int64_t id = 0;
  first_ids_.clear();
  for (const ShapeSpec& shape : scene_.shapes) {
    first_ids_.push_back((int32_t)id);
    id += shape.kind == Kind::kMesh ? triangles_[shape.mesh].face_count : 1;
    if (id > std::numeric_limits<int32_t>::max()) throw std::invalid_argument("more than two billion triangles");
  }
}

Renderer::Bounds Renderer::bounds_of(const ShapeSpec& shape) const {
  const double x = shape.size[0], y = shape.size[1], z = shape.size[2];
  Bounds bounds{};
  switch (shape.kind) {
    case Kind::kMesh: break;
    case Kind::kPlane: bounds.high = {x > 0 ? x : kEndless, y > 0 ? y : kEndless, 0.0}; break;
    case Kind::kSphere: bounds.high = {x, x, x}; break;
    case Kind::kCylinder: bounds.high = {x, x, y}; break;
    case Kind::kCapsule: bounds.high = {x, x, x + y}; break;
    case Kind::kBox:
    case Kind::kEllipsoid: bounds.high = {x, y, z}; break;
  }
  double square = 0.0;
  for (int i = 0; i < 3; ++i) {
    bounds.low[i] = -bounds.high[i];
    if (shape.kind == Kind::kMesh)
      bounds.low[i] = scene_.meshes[shape.mesh].low[i], bounds.high[i] = scene_.meshes[shape.mesh].high[i];
    const double half = 0.5 * (bounds.high[i] - bounds.low[i]);
    bounds.middle[i] = bounds.low[i] + half;
    square += half * half;
  }
  bounds.radius = std::sqrt(square) * 1.0001 + 1e-4;
  return bounds;
}

bool Renderer::is_endless(const ShapeSpec& shape) const {
  return shape.kind == Kind::kPlane && !(shape.size[0] > 0 && shape.size[1] > 0);
}

// Where a shape is as seen from somewhere; nothing where it is nowhere.
std::optional<Frame> Renderer::orient(const Frame& world_from_camera, size_t index, Solid& solid) const {
  const ShapeSpec& shape = scene_.shapes[index];
  if (!shape_poses_[index]) return std::nullopt;
  const Frame& world_from_shape = *shape_poses_[index];
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
    if (!std::isfinite(solid.eye[i]) || !std::isfinite(solid.centre[i])) return std::nullopt;
  }
  solid.kind = shape.kind;
  solid.look = &looks_[index];
  solid.first_id = first_ids_[index];
  solid.index = (int32_t)index;
  solid.mesh = shape.kind == Kind::kMesh ? &triangles_[shape.mesh] : nullptr;
  solid.id_count = solid.mesh ? solid.mesh->face_count : 1;
  if (solid.id_count == 0) return std::nullopt;
  return camera_from_shape;
}

bool Renderer::place(const View& view, const Frame& world_from_camera, size_t index, Solid& solid) const {
  const auto camera_from_shape = orient(world_from_camera, index, solid);
  if (!camera_from_shape) return false;
  const ShapeSpec& shape = scene_.shapes[index];
  if (is_endless(shape)) {
    solid.left = solid.top = 0, solid.right = view.width, solid.bottom = view.height;
    return solid.eye[2] > 0.0f;
  }
  const auto& [low, high, middle, radius] = bounds_[index];
  const Rectangle pixels = covered(view, *camera_from_shape, low, high);
  solid.left = pixels.left, solid.top = pixels.top, solid.right = pixels.right, solid.bottom = pixels.bottom;
  return !pixels.empty();
}

void Renderer::cast(const Frame& world_from_place, const float* directions, size_t count, float reach,
                    int32_t exclude, float* ranges, int32_t* shapes) {
  if (trees_.empty())
    for (const Triangles& mesh : triangles_) trees_.push_back(mesh.face_count > 0 ? make_bvh(mesh) : Bvh());
  solids_.clear();
  for (size_t i = 0; i < scene_.shapes.size(); ++i) {
    const ShapeSpec& shape = scene_.shapes[i];
    Solid solid;
    if (shape.body == exclude || !shape_poses_[i]) continue;
    solid.radius = solid.reach = -1.0f;
    if (!is_endless(shape)) {
      const double radius = bounds_[i].radius;
      const Vec3 middle = world_from_place.move_back(shape_poses_[i]->move(bounds_[i].middle));
      const double away = middle[0] * middle[0] + middle[1] * middle[1] + middle[2] * middle[2];
      if (std::sqrt(away) - radius > reach) continue;
      for (int axis = 0; axis < 3; ++axis) solid.middle[axis] = (float)middle[axis];
      // What single precision loses in the difference of two large squares is added.
      solid.radius = (float)radius, solid.reach = (float)(away - radius * radius - 1e-6 * away);
    }
    if (!orient(world_from_place, i, solid)) continue;
    if (shape.kind == Kind::kMesh) solid.bvh = trees_[shape.mesh].view();
    solids_.push_back(solid);
  }
  best_kernel().cast(solids_.data(), (int32_t)solids_.size(), directions, (int64_t)count, reach, ranges, shapes);
}

// Flat things lie on the ground: what a plane would shade is below it.
void Renderer::draw_maps() {
  std::vector<size_t> casters;
  std::vector<Corners> corners;
  for (size_t i = 0; i < scene_.shapes.size(); ++i) {
    const ShapeSpec& shape = scene_.shapes[i];
    const auto& world_from_shape = shape_poses_[i];
    if (!shape.casts_shadow || shape.kind == Kind::kPlane || looks_[i].opacity < 1.0f || !world_from_shape) continue;
    const auto& [low, high, middle, radius] = bounds_[i];
    if (!(low[0] <= high[0])) continue;
    Corners box;
    for (int corner = 0; corner < 8; ++corner)
      box[corner] = world_from_shape->move({corner & 1 ? high[0] : low[0], corner & 2 ? high[1] : low[1],
                                           corner & 4 ? high[2] : low[2]});
    if (!std::all_of(box.begin(), box.end(), [](const Vec3& p) { return std::isfinite(p[0] + p[1] + p[2]); })) continue;
    casters.push_back(i);
    corners.push_back(box);
  }
  const Kernel& kernel = best_kernel();
  for (size_t i = 0; i < maps_.size(); ++i) {
    const LightSpec& light = scene_.lights[i];
    const auto body = light.body < 0 ? Frame() : body_poses_[light.body];
    maps_[i] = light.casts_shadows && body ? look_from(light, *body, corners) : std::nullopt;
    if (!maps_[i]) continue;
    const Buffers buffers{maps_[i]->nearness.data(), nullptr, nullptr, nullptr, projected_.data()};
    for (const size_t caster : casters) {
      Solid solid;
      if (place(maps_[i]->view, maps_[i]->world_from_view, caster, solid)) kernel.see(maps_[i]->view, solid, buffers);
    }
  }
  maps_are_old_ = false;
}

void Renderer::clear(const View& view, const Frame& world_from_camera, bool segment) {
  const size_t count = (size_t)view.stride * (size_t)view.height;
  nearness_.assign(count, 1.0f / view.far_);
  id_.assign(count, -1);
  if (segment) segment_.assign(count, -1);
  const auto [horizon, zenith] = scene_.sky;
  const auto word = [&](double up) {
    int32_t colour = 0;
    for (int i = 0; i < 3; ++i) colour |= byte_of(horizon[i] + up * ((double)zenith[i] - horizon[i])) << (8 * i);
    return colour;
  };
  colour_.assign(count, word(0.0));
  if (horizon == zenith) return;
  const auto& r = world_from_camera.rotation;
  for (int32_t row = 0; row < view.height; ++row)
    for (int32_t column = 0; column < view.width; ++column) {
      const double y = (view.centre_u - (column + 0.5)) / view.focal, z = (view.centre_v - (row + 0.5)) / view.focal;
      const double up = (r[6] + r[7] * y + r[8] * z) / std::sqrt(1.0 + y * y + z * z);
      if (up > 0.0) colour_[(size_t)row * view.stride + column] = word(std::sqrt(up));
    }
}

// Over what is there already, seen through a buffer of its own.
void Renderer::draw_see_through(const View& view, const Solid& solid, const Lighting& lighting, Buffers buffers) {
  for (int32_t row = solid.top; row < solid.bottom; ++row) {
    const auto from = nearness_.begin() + (ptrdiff_t)row * view.stride;
    std::copy(from, from + view.stride, nearness_through_.begin() + (ptrdiff_t)row * view.stride);
    std::fill_n(id_through_.begin() + (ptrdiff_t)row * view.stride, view.stride, -1);
  }
  buffers.nearness = nearness_through_.data(), buffers.id = id_through_.data();
  best_kernel().see(view, solid, buffers);
  best_kernel().shade(view, solid, lighting, buffers);
}

// Words of three bytes into bytes, four at a time.
void pack(const int32_t* words, int32_t count, uint8_t* bytes) {
  int32_t i = 0;
  for (; i + 4 <= count; i += 4, bytes += 12) {
    const auto a = (uint32_t)words[i], b = (uint32_t)words[i + 1], c = (uint32_t)words[i + 2], d = (uint32_t)words[i + 3];
    const uint32_t packed[3] = {a | b << 24, b >> 8 | c << 16, c >> 16 | d << 8};
    std::memcpy(bytes, packed, sizeof packed);
  }
  for (; i < count; ++i, bytes += 3)
    for (int channel = 0; channel < 3; ++channel) bytes[channel] = (uint8_t)(words[i] >> (8 * channel));
}

void Renderer::render(const Camera& camera, uint8_t* rgb, float* depth, int32_t* segment) {
  const int32_t stride = (camera.width + kWidest - 1) / kWidest * kWidest;
  const View view{camera.width, camera.height, stride, camera.width * 0.5f, camera.height * 0.5f,
                  (float)camera.focal, (float)camera.near_, (float)camera.far_, false};
  if (maps_are_old_) draw_maps();
  clear(view, camera.world_from_camera, segment != nullptr);
  const Buffers buffers{nearness_.data(), id_.data(), colour_.data(), segment ? segment_.data() : nullptr,
                        projected_.data()};
  std::vector<Light> lights;
  std::vector<ShadowMap> maps(maps_.size());
  for (size_t i = 0; i < maps_.size(); ++i) {
    const LightSpec& light = scene_.lights[i];
    const auto body = light.body < 0 ? Frame() : body_poses_[light.body];
    if (!body) continue;
    if (maps_[i]) maps[i] = map_for(*maps_[i], camera.world_from_camera);
    lights.push_back(light_for(light, *body, camera.world_from_camera, maps_[i] ? &maps[i] : nullptr));
  }
  Lighting lighting{{}, lights.data(), (int32_t)lights.size(), scene_.fog};
  copy(scene_.ambient, lighting.ambient);
  std::vector<Solid> solids, see_through;
  for (size_t i = 0; i < scene_.shapes.size(); ++i) {
    Solid solid;
    if (looks_[i].opacity > 0.0f && place(view, camera.world_from_camera, i, solid))
      (looks_[i].opacity < 1.0f ? see_through : solids).push_back(solid);
  }
  const Kernel& kernel = best_kernel();
  for (const Solid& solid : solids) kernel.see(view, solid, buffers);
  for (const Solid& solid : solids) kernel.shade(view, solid, lighting, buffers);
  if (!see_through.empty()) {
    const auto away = [](const Solid& solid) {
      return solid.centre[0] * solid.centre[0] + solid.centre[1] * solid.centre[1] + solid.centre[2] * solid.centre[2];
    };
    std::stable_sort(see_through.begin(), see_through.end(),
                     [&](const Solid& a, const Solid& b) { return away(a) > away(b); });
    nearness_through_.resize(nearness_.size());
    id_through_.resize(id_.size());
    for (const Solid& solid : see_through) draw_see_through(view, solid, lighting, buffers);
  }
  for (int32_t row = 0; row < camera.height; ++row) {
    const size_t from = (size_t)row * stride, to = (size_t)row * camera.width;
    pack(colour_.data() + from, camera.width, rgb + 3 * to);
    if (depth)
      for (int32_t column = 0; column < camera.width; ++column)
        depth[to + column] = id_[from + column] < 0 ? std::numeric_limits<float>::infinity()
                                                    : 1.0f / nearness_[from + column];
    if (segment) std::copy_n(segment_.data() + from, camera.width, segment + to);
  }
}

}  // namespace trundle
