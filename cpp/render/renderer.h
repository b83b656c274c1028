// Renderer of a scene: camera images and ray casts.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bvh.h"
#include "geometry.h"
#include "kernel.h"
#include "light.h"
#include "mesh_lod.h"
#include "transform.h"

namespace trundle {

struct MaterialSpec {
  std::array<float, 3> ambient{}, diffuse{}, specular{}, emissive{};
  float shininess = 0, opacity = 1;
  int32_t texture = -1;  // index, or -1
  std::array<float, 2> repeat{1, 1};
};

struct ShapeSpec {
  ShapeKind kind;
  int32_t body;
  int32_t mesh;  // index, for ShapeKind::kMesh
  Vec3 size;
  Transform body_from_shape;
  MaterialSpec material;
  bool casts_shadow = true;
};

struct SceneSpec {
  int32_t bodies = 0;
  std::vector<Mesh> meshes;
  std::vector<Image> textures;
  std::vector<ShapeSpec> shapes;
  std::vector<LightSpec> lights;
  std::array<float, 3> ambient{};
  Sky sky{};
  Fog fog{};
};

// Camera and output arrays: (height, width, 3), (height, width), (height, width); the last two may be null.
struct CameraTarget {
  Transform world_from_camera;
  int32_t width, height;
  double focal, near_, far_;
  uint8_t* rgb;
  float* depth;
  int32_t* segmentation;
};

// Cache-aligned buffer that only grows; growing loses its contents.
template <typename Number>
class Scratch {
 public:
  void reserve(size_t count) {
    const size_t lines = (count + kMaxLanes - 1) / kMaxLanes;
    if (lines > count_) {
      lines_.reset(new Line[lines]);
      count_ = lines;
    }
  }
  Number* data() { return lines_ ? lines_[0].numbers : nullptr; }

 private:
  struct alignas(64) Line {
    Number numbers[kMaxLanes];
  };
  std::unique_ptr<Line[]> lines_;
  size_t count_ = 0;
};

constexpr int32_t kMaxThreads = 64;

class Renderer {
 public:
  // Throws std::invalid_argument if an index is out of range. Images do not depend on the number of threads.
  explicit Renderer(SceneSpec scene, int32_t threads = 1);
  Renderer(const Renderer&) = delete;

  void update(const double* poses);         // (bodies, 7)
  void set_mesh(int32_t index, Mesh mesh);  // for all shapes that use it
  // Changes that do not need a new scene. Throw as the constructor does.
  void set_material(int32_t shape, const MaterialSpec& material);
  void set_lighting(std::vector<LightSpec> lights, const std::array<float, 3>& ambient, const Sky& sky);
  // All targets in one pass; threads share their rows.
  void render(const std::vector<CameraTarget>& targets);
  // Ranges to the nearest shapes [m] and their indices; infinity and -1 without a hit. directions: (count, 3), unit, in
  // the origin's frame. Shapes of the body `exclude` are ignored.
  void cast_rays(const Transform& world_from_origin, const double* directions, size_t count, double max_range,
                 int32_t exclude, double* ranges, int32_t* shapes);
  int32_t bodies() const { return scene_.bodies; }

 private:
  struct Bounds {  // in the shape's frame [m]: box, sphere, and infinite cylinder along one axis
    Vec3 low, high, centre;
    double radius, cylinder_radius;
    int32_t axis;
  };
  void update_shape_poses();
  Material material_of(const ShapeSpec& shape) const;
  void check_lights() const;
  Bounds bounds_of(const ShapeSpec& shape) const;
  bool is_infinite(const ShapeSpec& shape) const;
  std::optional<Transform> make_renderable(const Transform& world_from_camera, size_t index,
                                           Renderable& renderable) const;
  bool make_target(const Transform& world_from_origin, size_t index, double max_range, RayTarget& target) const;
  enum class Detail { kFull, kLod };  // detail of meshes: all triangles, or fewer without a visible difference
  bool project_shape(const View& view, const Transform& world_from_camera, size_t index, Detail detail,
                     Renderable& renderable);
  const Triangles& select_lod(int32_t mesh, double tolerance);
  void assign_face_ids();
  void render_shadow_maps();
  struct Band;
  template <typename Work>
  void for_each_band(const std::vector<View>& views, const Work& work);
  void sort_front_to_back(std::vector<Renderable>& renderables) const;
  void rasterize_all(const View& view, const std::vector<Renderable>& renderables, const Band& band,
                     Buffers buffers) const;
  struct VisibleSet;  // shapes and lights in a camera frame
  VisibleSet find_visible(const CameraTarget& target, const View& view);
  void draw(const CameraTarget& target, const View& view, const VisibleSet& visible, const Band& band);

  SceneSpec scene_;
  std::vector<Triangles> triangles_;
  std::vector<Bvh> bvhs_;                                  // built at the first ray cast
  std::vector<std::optional<std::vector<MeshLod>>> lods_;  // per mesh, built on first use
  std::vector<Material> materials_;
  std::vector<int32_t> first_ids_;
  std::vector<Bounds> bounds_;
  std::vector<std::optional<Transform>> body_poses_;        // empty: not drawn
  std::vector<std::optional<Transform>> shape_poses_;       // in the world
  std::vector<RayTarget> targets_;                          // targets of the last ray cast
  std::vector<BoundingVolumes> volumes_;                    // of targets_
  std::vector<int32_t> candidates_;                         // scratch
  std::vector<std::optional<ShadowMapImage>> shadow_maps_;  // per light
  bool shadow_maps_dirty_ = true;
  struct Workspace {  // per thread
    Scratch<float> projected, inverse_depth, inverse_depth_through, hi_z, hi_z_through;
    Scratch<int32_t> large_faces, id, id_through, color, segmentation;
    void reserve(const Mesh& mesh);
  };
  std::vector<Workspace> workspaces_;
};

}  // namespace trundle
