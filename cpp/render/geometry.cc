#include "geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace trundle {

namespace {

size_t padded(size_t count) { return (count + kMaxLanes - 1) / kMaxLanes * kMaxLanes; }

double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Linear interpolant of values at a triangle's corners: gradient, and value at the origin.
void add_plane(std::vector<float>& planes, const Vec3& origin, const Vec3& a, const Vec3& b, double at_origin,
               double at_a, double at_b) {
  const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), area = aa * bb - ab * ab;
  const double da = at_a - at_origin, db = at_b - at_origin;
  const double along_a = (da * bb - db * ab) / area, along_b = (db * aa - da * ab) / area;
  Vec3 gradient;
  for (int axis = 0; axis < 3; ++axis) gradient[axis] = along_a * a[axis] + along_b * b[axis];
  for (const double slope : gradient) planes.push_back(static_cast<float>(slope));
  planes.push_back(static_cast<float>(at_origin - dot(gradient, origin)));
}

// Interpolants of the corners' normals; returns whether they differ from the face's.
bool add_normal_planes(std::vector<float>& planes, const float* normals, const Vec3& flat, const Vec3& origin,
                       const Vec3& a, const Vec3& b) {
  std::array<Vec3, 3> at;
  bool smooth = false;
  for (int corner = 0; corner < 3; ++corner) {
    const Vec3 n = {normals[3 * corner], normals[3 * corner + 1], normals[3 * corner + 2]};
    const double length = std::sqrt(dot(n, n));
    const bool is_one = length > 1e-6 && std::isfinite(length);
    at[corner] = is_one ? Vec3{n[0] / length, n[1] / length, n[2] / length} : flat;
    smooth |= dot(at[corner], flat) < 0.99999;
  }
  for (int axis = 0; axis < 3; ++axis) add_plane(planes, origin, a, b, at[0][axis], at[1][axis], at[2][axis]);
  return smooth;
}

}  // namespace

Triangles Mesh::triangles() const {
  return {{positions[0].data(), positions[1].data(), positions[2].data()},
          {corners[0].data(), corners[1].data(), corners[2].data()},
          normals.data(),
          uv_planes.empty() ? nullptr : uv_planes.data(),
          normal_planes.empty() ? nullptr : normal_planes.data(),
          vertex_count,
          face_count};
}

Mesh make_mesh(const std::vector<float>& vertices, const std::vector<int32_t>& faces, const std::vector<float>& uv,
               const std::vector<float>& normals) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  Mesh mesh;
  mesh.vertex_count = static_cast<int32_t>(vertices.size() / 3);
  for (int axis = 0; axis < 3; ++axis) {
    mesh.positions[axis].resize(padded(static_cast<size_t>(mesh.vertex_count)), 0.0f);
    for (int32_t i = 0; i < mesh.vertex_count; ++i)
      mesh.positions[axis][i] = vertices[3 * static_cast<size_t>(i) + axis];
  }
  mesh.low = {inf, inf, inf};
  mesh.high = {-inf, -inf, -inf};
  if (!uv.empty() && uv.size() != 2 * faces.size())
    throw std::invalid_argument("there must be one texture coordinate for each corner of each face");
  if (!normals.empty() && normals.size() != 3 * faces.size())
    throw std::invalid_argument("there must be one normal for each corner of each face");
  bool smooth = false;
  for (size_t i = 0; i + 2 < faces.size(); i += 3) {
    double p[3][3];
    for (int corner = 0; corner < 3; ++corner) {
      const int32_t vertex = faces[i + corner];
      if (vertex < 0 || vertex >= mesh.vertex_count)
        throw std::invalid_argument("a face names a vertex that does not exist");
      for (int axis = 0; axis < 3; ++axis) p[corner][axis] = mesh.positions[axis][vertex];
    }
    Vec3 a, b;
    for (int axis = 0; axis < 3; ++axis) {
      a[axis] = p[1][axis] - p[0][axis];
      b[axis] = p[2][axis] - p[0][axis];
    }
    const Vec3 n = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    const double length = std::sqrt(dot(n, n));
    if (!(length > 0.0) || !std::isfinite(length)) continue;
    for (int axis = 0; axis < 3; ++axis) {
      mesh.corners[axis].push_back(faces[i + axis]);
      mesh.normals.push_back(static_cast<float>(n[axis] / length));
      for (const auto& corner : p) {
        mesh.low[axis] = std::min(mesh.low[axis], corner[axis]);
        mesh.high[axis] = std::max(mesh.high[axis], corner[axis]);
      }
    }
    mesh.normals.push_back(0.0f);
    const Vec3 origin = {p[0][0], p[0][1], p[0][2]};
    for (int axis = 0; axis < 2 && !uv.empty(); ++axis) {
      const double first = uv[2 * i + axis],
                   whole = std::floor(first);  // textures repeat: small coordinates keep their precision
      add_plane(mesh.uv_planes, origin, a, b, first - whole, uv[2 * i + 2 + axis] - whole,
                uv[2 * i + 4 + axis] - whole);
    }
    const Vec3 flat = {n[0] / length, n[1] / length, n[2] / length};
    if (!normals.empty()) smooth |= add_normal_planes(mesh.normal_planes, &normals[3 * i], flat, origin, a, b);
  }
  if (!smooth) mesh.normal_planes.clear();
  mesh.face_count = static_cast<int32_t>(mesh.corners[0].size());
  for (auto& corner : mesh.corners) corner.resize(padded(corner.size()), 0);
  return mesh;
}

Image make_image(const uint8_t* rgb, int32_t width, int32_t height) {
  if (width < 1 || height < 1 || width > 16384 || height > 16384)
    throw std::invalid_argument("a texture is 1 to 16384 pixels wide and high");
  Image image;
  Texture& texture = image.texture;
  // With the first column and row repeated at the end.
  const auto add_level = [&](int32_t columns, int32_t rows, const auto& word_at) {
    const int32_t level = texture.level_count++;
    texture.start[level] = static_cast<int32_t>(image.texels.size());
    texture.width[level] = columns;
    texture.height[level] = rows;
    for (int32_t row = 0; row <= rows; ++row)
      for (int32_t column = 0; column <= columns; ++column)
        image.texels.push_back(word_at(column % columns, row % rows));
  };
  add_level(width, height, [&](int32_t column, int32_t row) {
    const uint8_t* pixel = rgb + 3 * (static_cast<size_t>(height - 1 - row) * width + column);
    return pixel[0] | pixel[1] << 8 | pixel[2] << 16;
  });
  while ((width > 1 || height > 1) && texture.level_count < kMaxMipLevels) {
    const int32_t from = texture.start[texture.level_count - 1], pitch = width + 1;
    add_level(std::max(width / 2, 1), std::max(height / 2, 1), [&](int32_t column, int32_t row) {
      const int32_t x0 = std::min(2 * column, width - 1), x1 = std::min(2 * column + 1, width - 1);
      const int32_t y0 = std::min(2 * row, height - 1), y1 = std::min(2 * row + 1, height - 1);
      int32_t word = 0;
      for (const int shift : {0, 8, 16}) {
        int32_t sum = 2;
        for (const int32_t y : {y0, y1})
          for (const int32_t x : {x0, x1}) sum += image.texels[from + y * pitch + x] >> shift & 255;
        word |= sum / 4 << shift;
      }
      return word;
    });
    width = std::max(width / 2, 1);
    height = std::max(height / 2, 1);
  }
  return image;
}

}  // namespace trundle
