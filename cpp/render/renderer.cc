#include "renderer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace trundle {

namespace {

constexpr double kInfiniteExtent = 1e6;  // [m]
constexpr double kLodTolerance = 0.3;    // [px] largest displacement of a vertex

bool is_finite(const Vec3& numbers) {
  return std::all_of(numbers.begin(), numbers.end(),
                     [](double number) { return std::isfinite(static_cast<float>(number)); });
}

bool is_index(int32_t index, size_t count) { return index >= 0 && static_cast<size_t>(index) < count; }

void copy(const std::array<float, 3>& from, float* to) { std::copy(from.begin(), from.end(), to); }

// Largest distance of a face's corner from a point [m].
double radius_about(const Triangles& mesh, const Vec3& from) {
  double square = 0.0;
  for (const int32_t* corner : mesh.corners)
    for (int32_t face = 0; face < mesh.face_count; ++face) {
      double away = 0.0;
      for (int axis = 0; axis < 3; ++axis) away += std::pow(mesh.positions[axis][corner[face]] - from[axis], 2);
      square = std::max(square, away);
    }
  return std::sqrt(square);
}

Material make_material(const MaterialSpec& spec, const std::vector<Image>& textures) {
  Material material{};
  copy(spec.ambient, material.ambient);
  copy(spec.diffuse, material.diffuse);
  copy(spec.specular, material.specular);
  copy(spec.emissive, material.emissive);
  material.shininess = std::isfinite(spec.shininess) ? std::clamp(spec.shininess, 0.0f, 1000.0f) : 0.0f;
  material.opacity = std::isfinite(spec.opacity) ? std::clamp(spec.opacity, 0.0f, 1.0f) : 1.0f;
  material.repeat[0] = spec.repeat[0];
  material.repeat[1] = spec.repeat[1];
  material.texture = spec.texture < 0 ? nullptr : &textures[spec.texture].texture;
  return material;
}

}  // namespace

Renderer::Renderer(SceneSpec scene, int32_t threads)
    : scene_(std::move(scene)),
      body_poses_(static_cast<size_t>(scene_.bodies), Transform()),
      shadow_maps_(scene_.lights.size()) {
  workspaces_.resize(static_cast<size_t>(std::clamp(threads, 1, kMaxThreads)));
  for (const Mesh& mesh : scene_.meshes) {
    triangles_.push_back(mesh.triangles());
    for (Workspace& workspace : workspaces_) workspace.reserve(mesh);
  }
  for (Image& image : scene_.textures) image.texture.texels = image.texels.data();
  for (const ShapeSpec& shape : scene_.shapes) {
    if (!is_index(shape.body, static_cast<size_t>(scene_.bodies)))
      throw std::invalid_argument("a shape is on a body that does not exist");
    if (shape.kind == ShapeKind::kMesh && !is_index(shape.mesh, scene_.meshes.size()))
      throw std::invalid_argument("a shape refers to a mesh that does not exist");
    materials_.push_back(material_of(shape));
  }
  check_lights();
  lods_.resize(scene_.meshes.size());
  assign_face_ids();
  shape_poses_.resize(scene_.shapes.size());
  for (const ShapeSpec& shape : scene_.shapes) bounds_.push_back(bounds_of(shape));
  update_shape_poses();
}

Material Renderer::material_of(const ShapeSpec& shape) const {
  if (shape.material.texture != -1 && !is_index(shape.material.texture, scene_.textures.size()))
    throw std::invalid_argument("a shape refers to a texture that does not exist");
  Material material = make_material(shape.material, scene_.textures);
  if (shape.kind == ShapeKind::kMesh && !triangles_[shape.mesh].uv_planes) material.texture = nullptr;
  return material;
}

void Renderer::check_lights() const {
  for (const LightSpec& light : scene_.lights)
    if (light.body != -1 && !is_index(light.body, static_cast<size_t>(scene_.bodies)))
      throw std::invalid_argument("a light is on a body that does not exist");
}

void Renderer::set_material(int32_t shape, const MaterialSpec& material) {
  if (!is_index(shape, scene_.shapes.size())) throw std::invalid_argument("there is no such shape");
  scene_.shapes[shape].material = material;
  materials_[shape] = material_of(scene_.shapes[shape]);
  shadow_maps_dirty_ = true;  // a shape may have become transparent
}

void Renderer::set_lighting(std::vector<LightSpec> lights, const std::array<float, 3>& ambient, const Sky& sky) {
  scene_.lights = std::move(lights);
  scene_.ambient = ambient;
  scene_.sky = sky;
  check_lights();
  shadow_maps_ = std::vector<std::optional<ShadowMapImage>>(scene_.lights.size());
  shadow_maps_dirty_ = true;
}

void Renderer::Workspace::reserve(const Mesh& mesh) {
  projected.reserve(6 * mesh.positions[0].size());
  large_faces.reserve(mesh.corners[0].size());
}

void Renderer::update(const double* poses) {
  for (size_t i = 0; i < body_poses_.size(); ++i) {
    const auto pose = Transform::from_pose(poses + 7 * i);
    const auto& old = body_poses_[i];
    shadow_maps_dirty_ |= pose.has_value() != old.has_value() ||
                          (pose && (pose->position != old->position || pose->rotation != old->rotation));
    body_poses_[i] = pose;
  }
  update_shape_poses();
}

void Renderer::update_shape_poses() {
  for (size_t i = 0; i < scene_.shapes.size(); ++i) {
    const ShapeSpec& shape = scene_.shapes[i];
    const auto& body = body_poses_[shape.body];
    shape_poses_[i] = body && is_finite(shape.size) ? std::optional(*body * shape.body_from_shape) : std::nullopt;
  }
}

void Renderer::set_mesh(int32_t index, Mesh mesh) {
  if (index < 0 || static_cast<size_t>(index) >= scene_.meshes.size())
    throw std::invalid_argument("there is no such mesh");
  if (triangles_[index].uv_planes && mesh.uv_planes.empty() && mesh.face_count > 0)
    throw std::invalid_argument("a textured mesh needs texture coordinates");
  scene_.meshes[index] = std::move(mesh);
  triangles_[index] = scene_.meshes[index].triangles();
  lods_[index].emplace();  // no levels of detail for a mesh that deforms
  for (Workspace& workspace : workspaces_) workspace.reserve(scene_.meshes[index]);
  if (!bvhs_.empty()) bvhs_[index] = triangles_[index].face_count > 0 ? make_bvh(triangles_[index]) : Bvh();
  for (size_t i = 0; i < scene_.shapes.size(); ++i)
    if (scene_.shapes[i].kind == ShapeKind::kMesh && scene_.shapes[i].mesh == index)
      bounds_[i] = bounds_of(scene_.shapes[i]);
  assign_face_ids();
  shadow_maps_dirty_ = true;
}

// One id per face of a mesh, one per other shape.
void Renderer::assign_face_ids() {
  int64_t id = 0;
  first_ids_.clear();
  for (const ShapeSpec& shape : scene_.shapes) {
    first_ids_.push_back(static_cast<int32_t>(id));
    id += shape.kind == ShapeKind::kMesh ? triangles_[shape.mesh].face_count : 1;
    if (id > std::numeric_limits<int32_t>::max()) throw std::invalid_argument("more than two billion triangles");
  }
}

Renderer::Bounds Renderer::bounds_of(const ShapeSpec& shape) const {
  const double x = shape.size[0], y = shape.size[1], z = shape.size[2];
  Bounds bounds{};
  switch (shape.kind) {
    case ShapeKind::kMesh: break;
    case ShapeKind::kPlane: bounds.high = {x > 0 ? x : kInfiniteExtent, y > 0 ? y : kInfiniteExtent, 0.0}; break;
    case ShapeKind::kSphere: bounds.high = {x, x, x}; break;
    case ShapeKind::kCylinder: bounds.high = {x, x, y}; break;
    case ShapeKind::kCapsule: bounds.high = {x, x, x + y}; break;
    case ShapeKind::kBox:
    case ShapeKind::kEllipsoid: bounds.high = {x, y, z}; break;
  }
  for (int i = 0; i < 3; ++i) {
    bounds.low[i] = -bounds.high[i];
    if (shape.kind == ShapeKind::kMesh) {
      bounds.low[i] = scene_.meshes[shape.mesh].low[i];
      bounds.high[i] = scene_.meshes[shape.mesh].high[i];
    }
    bounds.centre[i] = bounds.low[i] + 0.5 * (bounds.high[i] - bounds.low[i]);
  }
  double radius = 0.0;
  switch (shape.kind) {
    case ShapeKind::kMesh: radius = radius_about(triangles_[shape.mesh], bounds.centre); break;
    case ShapeKind::kSphere: radius = x; break;
    case ShapeKind::kCylinder: radius = std::hypot(x, y); break;
    case ShapeKind::kCapsule: radius = x + y; break;
    case ShapeKind::kEllipsoid: radius = std::max({x, y, z}); break;
    case ShapeKind::kPlane:
    case ShapeKind::kBox: radius = std::hypot(bounds.high[0], bounds.high[1], bounds.high[2]);
  }
  bounds.radius = radius * 1.0001 + 1e-4;
  const bool is_box = shape.kind == ShapeKind::kBox,
             is_round = shape.kind == ShapeKind::kCylinder || shape.kind == ShapeKind::kCapsule;
  bounds.axis = is_round || (z >= x && z >= y) ? 2 : y >= x ? 1 : 0;
  const double a = bounds.high[(bounds.axis + 1) % 3], b = bounds.high[(bounds.axis + 2) % 3];
  // A mesh need not be centred on its axes.
  bounds.cylinder_radius =
      shape.kind == ShapeKind::kMesh ? 1e15 : (is_box ? std::hypot(a, b) : std::max(a, b)) * 1.0001 + 1e-4;
  return bounds;
}

bool Renderer::is_infinite(const ShapeSpec& shape) const {
  return shape.kind == ShapeKind::kPlane && !(shape.size[0] > 0 && shape.size[1] > 0);
}

// Fill in the view-independent fields; returns camera_from_shape, or nothing if the shape is not drawn.
std::optional<Transform> Renderer::make_renderable(const Transform& world_from_camera, size_t index,
                                                   Renderable& renderable) const {
  const ShapeSpec& shape = scene_.shapes[index];
  if (!shape_poses_[index]) return std::nullopt;
  const Transform& world_from_shape = *shape_poses_[index];
  Transform camera_from_shape;
  for (int i = 0; i < 3; ++i) {
    const Vec3 axis = world_from_camera.inverse_rotate(world_from_shape.axis(i));
    for (int row = 0; row < 3; ++row) {
      camera_from_shape.rotation[3 * row + i] = axis[row];
      renderable.axes[3 * i + row] = static_cast<float>(axis[row]);
    }
  }
  camera_from_shape.position = world_from_camera.inverse_apply(world_from_shape.position);
  const Vec3 eye = world_from_shape.inverse_apply(world_from_camera.position);
  for (int i = 0; i < 3; ++i) {
    renderable.eye[i] = static_cast<float>(eye[i]);
    renderable.centre[i] = static_cast<float>(camera_from_shape.position[i]);
    renderable.size[i] = static_cast<float>(shape.size[i]);
    if (!std::isfinite(renderable.eye[i]) || !std::isfinite(renderable.centre[i])) return std::nullopt;
  }
  renderable.kind = shape.kind;
  renderable.material = &materials_[index];
  renderable.first_id = first_ids_[index];
  renderable.index = static_cast<int32_t>(index);
  renderable.lod_error = 0.0f;
  renderable.mesh = shape.kind == ShapeKind::kMesh ? &triangles_[shape.mesh] : nullptr;
  renderable.id_count = renderable.mesh ? renderable.mesh->face_count : 1;
  if (renderable.id_count == 0) return std::nullopt;
  return camera_from_shape;
}

// Coarsest level whose vertices moved by at most the tolerance [m].
const Triangles& Renderer::select_lod(int32_t mesh, double tolerance) {
  const Triangles& whole = triangles_[mesh];
  const Vec3 &low = scene_.meshes[mesh].low, &high = scene_.meshes[mesh].high;
  const double extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  if (whole.face_count < kMinLodFaces || !(tolerance > 0.5 * extent / kFinestGrid)) return whole;
  if (!lods_[mesh]) lods_[mesh] = make_lods(scene_.meshes[mesh]);
  const Triangles* selected = &whole;
  for (const MeshLod& level : *lods_[mesh])
    if (level.error <= tolerance) selected = &level.triangles;
  return *selected;
}

bool Renderer::project_shape(const View& view, const Transform& world_from_camera, size_t index, Detail detail,
                             Renderable& renderable) {
  const auto camera_from_shape = make_renderable(world_from_camera, index, renderable);
  if (!camera_from_shape) return false;
  const ShapeSpec& shape = scene_.shapes[index];
  if (is_infinite(shape)) {
    renderable.left = renderable.top = 0;
    renderable.right = view.width;
    renderable.bottom = view.height;
    renderable.max_inverse_depth = INFINITY;
    return renderable.eye[2] > 0.0f;
  }
  const Bounds& bounds = bounds_[index];
  if (detail == Detail::kLod && renderable.mesh) {
    const Vec3 seen = camera_from_shape->apply(bounds.centre);
    const double away =
        std::max(std::hypot(seen[0], seen[1], seen[2]) - bounds.radius, static_cast<double>(view.near_));
    const double tolerance = kLodTolerance * (view.orthographic ? 1.0 : away) / view.focal;
    renderable.mesh = &select_lod(shape.mesh, tolerance);
    if (renderable.mesh != &triangles_[shape.mesh]) renderable.lod_error = static_cast<float>(tolerance);
    renderable.id_count = renderable.mesh->face_count;
  }
  const Rectangle pixels = screen_bounds(view, *camera_from_shape, bounds.low, bounds.high);
  renderable.left = pixels.left;
  renderable.top = pixels.top;
  renderable.right = pixels.right;
  renderable.bottom = pixels.bottom;
  // With a margin for single precision's rounding.
  const double ahead = pixels.min_depth - 1e-3 * (std::fabs(pixels.min_depth) + bounds.radius);
  renderable.max_inverse_depth = view.orthographic    ? static_cast<float>(-ahead)
                                 : ahead > view.near_ ? static_cast<float>(1.0 / ahead)
                                                      : INFINITY;
  return !pixels.empty();
}

}  // namespace trundle
