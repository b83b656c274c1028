#include "renderer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace trundle {

namespace {

constexpr double kEndless = 1e6;  // [m]
constexpr double kUnseen = 0.3;   // [px] by which a vertex may be moved

bool is_finite(const Vec3& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite((float)number); });
}

void copy(const std::array<float, 3>& from, float* to) { std::copy(from.begin(), from.end(), to); }

// How far from a point its faces reach [m].
double farthest(const Triangles& mesh, const Vec3& from) {
  double square = 0.0;
  for (const int32_t* corner : mesh.corners)
    for (int32_t face = 0; face < mesh.face_count; ++face) {
      double away = 0.0;
      for (int axis = 0; axis < 3; ++axis) away += std::pow(mesh.places[axis][corner[face]] - from[axis], 2);
      square = std::max(square, away);
    }
  return std::sqrt(square);
}

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

Renderer::Renderer(SceneSpec scene, int32_t threads)
    : scene_(std::move(scene)), body_poses_((size_t)scene_.bodies, Frame()), maps_(scene_.lights.size()) {
  rooms_.resize((size_t)std::clamp(threads, 1, kMostThreads));
  for (const Mesh& mesh : scene_.meshes) {
    triangles_.push_back(mesh.triangles());
    for (Room& room : rooms_) room.fit(mesh);
  }
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
  coarse_.resize(scene_.meshes.size());
  number_faces();
  shape_poses_.resize(scene_.shapes.size());
  for (const ShapeSpec& shape : scene_.shapes) bounds_.push_back(bounds_of(shape));
  place_shapes();
}

void Renderer::Room::fit(const Mesh& mesh) {
  projected.fit(6 * mesh.places[0].size());
  large.fit(mesh.corners[0].size());
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
  coarse_[mesh].emplace();  // what changes its form is not made coarser each time
  for (Room& room : rooms_) room.fit(scene_.meshes[mesh]);
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
  for (int i = 0; i < 3; ++i) {
    bounds.low[i] = -bounds.high[i];
    if (shape.kind == Kind::kMesh)
      bounds.low[i] = scene_.meshes[shape.mesh].low[i], bounds.high[i] = scene_.meshes[shape.mesh].high[i];
    bounds.middle[i] = bounds.low[i] + 0.5 * (bounds.high[i] - bounds.low[i]);
  }
  double radius = 0.0;
  switch (shape.kind) {
    case Kind::kMesh: radius = farthest(triangles_[shape.mesh], bounds.middle); break;
    case Kind::kSphere: radius = x; break;
    case Kind::kCylinder: radius = std::hypot(x, y); break;
    case Kind::kCapsule: radius = x + y; break;
    case Kind::kEllipsoid: radius = std::max({x, y, z}); break;
    case Kind::kPlane:
    case Kind::kBox: radius = std::hypot(bounds.high[0], bounds.high[1], bounds.high[2]);
  }
  bounds.radius = radius * 1.0001 + 1e-4;
  const bool is_box = shape.kind == Kind::kBox, is_round = shape.kind == Kind::kCylinder || shape.kind == Kind::kCapsule;
  bounds.axis = is_round || (z >= x && z >= y) ? 2 : y >= x ? 1 : 0;
  const double a = bounds.high[(bounds.axis + 1) % 3], b = bounds.high[(bounds.axis + 2) % 3];
  // A mesh need not be about its own axes.
  bounds.thickness = shape.kind == Kind::kMesh ? 1e15 : (is_box ? std::hypot(a, b) : std::max(a, b)) * 1.0001 + 1e-4;
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
    solid.size[i] = (float)shape.size[i];
    if (!std::isfinite(solid.eye[i]) || !std::isfinite(solid.centre[i])) return std::nullopt;
  }
  solid.kind = shape.kind;
  solid.look = &looks_[index];
  solid.first_id = first_ids_[index];
  solid.index = (int32_t)index;
  solid.off = 0.0f;
  solid.mesh = shape.kind == Kind::kMesh ? &triangles_[shape.mesh] : nullptr;
  solid.id_count = solid.mesh ? solid.mesh->face_count : 1;
  if (solid.id_count == 0) return std::nullopt;
  return camera_from_shape;
}

// The coarsest one whose vertices are no farther from where they were than so many metres.
const Triangles& Renderer::mesh_for(int32_t mesh, double unseen) {
  const Triangles& whole = triangles_[mesh];
  const Vec3 &low = scene_.meshes[mesh].low, &high = scene_.meshes[mesh].high;
  const double extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  if (whole.face_count < kHeavy || !(unseen > 0.5 * extent / kFinest)) return whole;
  if (!coarse_[mesh]) coarse_[mesh] = coarser(scene_.meshes[mesh]);
  const Triangles* chosen = &whole;
  for (const Coarse& level : *coarse_[mesh])
    if (level.off <= unseen) chosen = &level.triangles;
  return *chosen;
}

bool Renderer::place(const View& view, const Frame& world_from_camera, size_t index, Detail detail, Solid& solid) {
  const auto camera_from_shape = orient(world_from_camera, index, solid);
  if (!camera_from_shape) return false;
  const ShapeSpec& shape = scene_.shapes[index];
  if (is_endless(shape)) {
    solid.left = solid.top = 0, solid.right = view.width, solid.bottom = view.height;
    solid.nearest = INFINITY;
    return solid.eye[2] > 0.0f;
  }
  const Bounds& bounds = bounds_[index];
  if (detail == Detail::kSeen && solid.mesh) {
    const Vec3 seen = camera_from_shape->move(bounds.middle);
    const double away = std::max(std::hypot(seen[0], seen[1], seen[2]) - bounds.radius, (double)view.near_);
    const double unseen = kUnseen * (view.parallel ? 1.0 : away) / view.focal;
    solid.mesh = &mesh_for(shape.mesh, unseen);
    if (solid.mesh != &triangles_[shape.mesh]) solid.off = (float)unseen;
    solid.id_count = solid.mesh->face_count;
  }
  const Rectangle pixels = covered(view, *camera_from_shape, bounds.low, bounds.high);
  solid.left = pixels.left, solid.top = pixels.top, solid.right = pixels.right, solid.bottom = pixels.bottom;
  // With more than single precision may make of it.
  const double ahead = pixels.ahead - 1e-3 * (std::fabs(pixels.ahead) + bounds.radius);
  solid.nearest = view.parallel ? (float)-ahead : ahead > view.near_ ? (float)(1.0 / ahead) : INFINITY;
  return !pixels.empty();
}

}  // namespace trundle
