// Meshes and textures, prepared for rendering.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kernel.h"
#include "transform.h"

namespace trundle {

struct Mesh {
  std::array<std::vector<float>, 3> positions;
  std::array<std::vector<int32_t>, 3> corners;
  std::vector<float> normals, uv_planes, normal_planes;
  int32_t vertex_count = 0, face_count = 0;
  Vec3 low{}, high{};
  Triangles triangles() const;
};

// vertices (V, 3), faces (F, 3), uv (F, 3, 2) and normals (F, 3, 3) per face corner; the latter two may be empty. A
// vertex index out of range throws std::invalid_argument; faces without area or with a NaN are dropped. An invalid
// corner normal is replaced by the face's.
Mesh make_mesh(const std::vector<float>& vertices, const std::vector<int32_t>& faces, const std::vector<float>& uv,
               const std::vector<float>& normals);

struct Image {
  std::vector<int32_t> texels;
  Texture texture{};  // storage of `texels`, which points here once the Image has its final address
};

// rgb: (height, width, 3), top row first.
Image make_image(const uint8_t* rgb, int32_t width, int32_t height);

}  // namespace trundle
