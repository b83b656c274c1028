// A scene, and pictures of it.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bvh.h"
#include "coarse.h"
#include "geometry.h"
#include "kernel.h"
#include "light.h"
#include "place.h"

namespace trundle {

struct LookSpec {
  std::array<float, 3> ambient{}, diffuse{}, specular{}, emissive{};
  float shininess = 0, opacity = 1;
  int32_t texture = -1;  // index, or -1
  std::array<float, 2> repeat{1, 1};
};

struct ShapeSpec {
  Kind kind;
  int32_t body;
  int32_t mesh;  // index, for Kind::kMesh
  Vec3 size;
  Frame body_from_shape;
  LookSpec look;
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

// A picture to be drawn, and where to: (height, width, 3), (height, width), (height, width); depth and segment may be null.
struct Shot {
  Frame world_from_camera;
  int32_t width, height;
  double focal, near_, far_;
  uint8_t* rgb;
  float* depth;
  int32_t* segment;
};

// Room that grows to what is asked for, in whole lines of the cache. What lies in it is of no meaning.
template <typename Number>
class Scratch {
 public:
  void fit(size_t count) {
    const size_t lines = (count + kWidest - 1) / kWidest;
    if (lines > count_) lines_.reset(new Line[lines]), count_ = lines;
  }
  Number* data() { return lines_ ? lines_[0].numbers : nullptr; }

 private:
  struct alignas(64) Line {
    Number numbers[kWidest];
  };
  std::unique_ptr<Line[]> lines_;
  size_t count_ = 0;
};

constexpr int32_t kMostThreads = 64;

class Renderer {
 public:
  // Throws std::invalid_argument where an index leads nowhere. Pictures are the same with any number of threads.
  explicit Renderer(SceneSpec scene, int32_t threads = 1);
  Renderer(const Renderer&) = delete;

  void update(const double* poses);  // (bodies, 7)
  void reshape(int32_t mesh, Mesh form);  // whatever shape bears that mesh changes
  // All of one instant. Threads share the rows of all of them.
  void render(const std::vector<Shot>& shots);
  // How far rays from one place go before they meet a shape [m], and which; infinity and -1 where they meet none. Unit
  // directions (count, 3) in the frame of that place; of the body `exclude`, nothing is met.
  void cast(const Frame& world_from_place, const double* directions, size_t count, double reach, int32_t exclude,
            double* ranges, int32_t* shapes);
  int32_t bodies() const { return scene_.bodies; }

 private:
  struct Bounds {  // in the shape's frame [m]: a box, a ball around it, and an endless pipe along one of its axes
    Vec3 low, high, middle;
    double radius, thickness;
    int32_t axis;
  };
  void place_shapes();
  Bounds bounds_of(const ShapeSpec& shape) const;
  bool is_endless(const ShapeSpec& shape) const;
  std::optional<Frame> orient(const Frame& world_from_camera, size_t index, Solid& solid) const;
  bool aim(const Frame& world_from_place, size_t index, double reach, Target& target) const;
  enum class Detail { kAll, kSeen };  // of meshes: every triangle, or what makes no difference to a picture
  bool place(const View& view, const Frame& world_from_camera, size_t index, Detail detail, Solid& solid);
  const Triangles& mesh_for(int32_t mesh, double unseen);
  void number_faces();
  void draw_maps();
  struct Band;
  template <typename Work>
  void in_bands(const std::vector<View>& views, const Work& work);
  void sort_by_nearness(std::vector<Solid>& solids) const;
  void see_all(const View& view, const std::vector<Solid>& solids, const Band& band, Buffers buffers) const;
  struct Sight;  // what a camera has before it
  Sight sight_of(const Shot& shot, const View& view);
  void draw(const Shot& shot, const View& view, const Sight& sight, const Band& band);

  SceneSpec scene_;
  std::vector<Triangles> triangles_;
  std::vector<Bvh> trees_;  // made when first a ray is cast
  std::vector<std::optional<std::vector<Coarse>>> coarse_;  // of each mesh, made when first one is so small
  std::vector<Look> looks_;
  std::vector<int32_t> first_ids_;
  std::vector<Bounds> bounds_;
  std::vector<std::optional<Frame>> body_poses_;  // nothing: nowhere, and not drawn
  std::vector<std::optional<Frame>> shape_poses_;  // in the world
  std::vector<Target> targets_;                    // that rays may meet
  std::vector<Around> around_;                     // those
  std::vector<int32_t> near_;                      // of those, that some may meet
  std::vector<std::optional<LightMap>> maps_;     // of each light
  bool maps_are_old_ = true;
  struct Room {  // of each thread; of pictures each touches the rows that it draws
    Scratch<float> projected, nearness, nearness_through, hidden, hidden_through;
    Scratch<int32_t> large, id, id_through, colour, segment;
    void fit(const Mesh& mesh);
  };
  std::vector<Room> rooms_;
};

}  // namespace trundle
