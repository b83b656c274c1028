// Meshes and images as they are kept for drawing.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kernel.h"
#include "place.h"

namespace trundle {

struct Mesh {
  std::array<std::vector<float>, 3> places;
  std::array<std::vector<int32_t>, 3> corners;
  std::vector<float> normals, layout, bend;
  int32_t vertex_count = 0, face_count = 0;
  Vec3 low{}, high{};
  Triangles triangles() const;
};

// `vertices` and `faces` hold three numbers each. For each corner of each face, `uv` holds two numbers and `normals`
// three; both may be empty. Faces whose corners do not exist throw std::invalid_argument; those without area or with a
// corner that is no number are left out of sight. Where a corner's normal is none, the face's is.
Mesh make_mesh(const std::vector<float>& vertices, const std::vector<int32_t>& faces, const std::vector<float>& uv,
               const std::vector<float>& normals);

struct Image {
  std::vector<int32_t> texels;
  Texture texture{};  // its texels are set where the image has come to rest
};

// From rows of red, green, blue, the highest row first.
Image make_image(const uint8_t* rgb, int32_t width, int32_t height);

}  // namespace trundle
