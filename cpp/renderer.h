// A scene, and pictures of it.
#pragma once

#include <cstdint>
#include <vector>

#include "kernel.h"
#include "place.h"

namespace trundle {

struct Mesh {
  std::vector<float> vertices, normals;
  std::vector<int32_t> faces;
  Vec3 low{}, high{};
  Triangles triangles() const;
};

// Faces whose corners do not exist throw std::invalid_argument; those without area or with a corner that is no number
// are left out of sight.
Mesh make_mesh(std::vector<float> vertices, std::vector<int32_t> faces);

struct ShapeSpec {
  Kind kind;
  int32_t body;
  int32_t mesh;  // index, for Kind::kMesh
  std::array<float, 3> size;
  Frame body_from_shape;
  std::array<float, 3> colour;
};

struct LightSpec {
  Vec3 direction;  // in the world: where the light travels to
  std::array<float, 3> diffuse;
};

struct Camera {
  Frame world_from_camera;
  int32_t width, height;
  double focal, near_, far_;
};

class Renderer {
 public:
  Renderer(int32_t bodies, std::vector<Mesh> meshes, std::vector<ShapeSpec> shapes, std::vector<LightSpec> lights,
           std::array<float, 3> ambient, std::array<float, 3> background);

  void update(const double* poses);  // (bodies, 7)
  // Into (height, width, 3), (height, width), (height, width); depth and segment may be null.
  void render(const Camera& camera, uint8_t* rgb, float* depth, int32_t* segment);
  int32_t bodies() const { return (int32_t)body_poses_.size(); }

 private:
  bool place(const View& view, const Frame& world_from_camera, size_t index, Solid& solid) const;

  std::vector<Mesh> meshes_;
  std::vector<Triangles> triangles_;
  std::vector<ShapeSpec> shapes_;
  std::vector<int32_t> first_ids_;
  std::vector<LightSpec> lights_;
  std::array<float, 3> ambient_;
  int32_t background_;
  std::vector<std::optional<Frame>> body_poses_;  // nothing: nowhere, and not drawn
  std::vector<float> nearness_, projected_;
  std::vector<int32_t> id_, colour_, segment_;
};

const Kernel& best_kernel();

}  // namespace trundle
