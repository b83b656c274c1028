#include "mesh_lod.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

namespace trundle {

namespace {

constexpr int kMaxLevels = 6;
constexpr size_t kMinFaces = 500;  // number of faces up to which a level is not simplified further

struct CellTriangle {
  std::array<int32_t, 3> cells;  // rotated so that the lowest comes first
  int32_t face;
};

// Cells in order of first use, and the mean of the vertices in each.
struct Grid {
  std::vector<int32_t> cells;  // cell of each vertex
  std::vector<Vec3> centres;
  double error = 0.0;

  Grid(const Mesh& mesh, const std::vector<bool>& used, double width)
      : cells(static_cast<size_t>(mesh.vertex_count), -1) {
    std::unordered_map<int64_t, int32_t> numbers;
    std::vector<int32_t> counts;
    for (int32_t i = 0; i < mesh.vertex_count; ++i) {
      if (!used[i]) continue;
      int64_t key = 0;
      for (int axis = 0; axis < 3; ++axis)
        key = key << 20 |
              static_cast<int64_t>(std::clamp((mesh.positions[axis][i] - mesh.low[axis]) / width, 0.0, kFinestGrid));
      const int32_t cell = cells[i] = numbers.try_emplace(key, static_cast<int32_t>(centres.size())).first->second;
      if (cell == static_cast<int32_t>(centres.size())) {
        centres.push_back({});
        counts.push_back(0);
      }
      for (int axis = 0; axis < 3; ++axis) centres[cell][axis] += mesh.positions[axis][i];
      ++counts[cell];
    }
    for (size_t cell = 0; cell < centres.size(); ++cell)
      for (double& coordinate : centres[cell]) coordinate /= counts[cell];
    for (int32_t i = 0; i < mesh.vertex_count; ++i) {
      if (!used[i]) continue;
      double square = 0.0;
      for (int axis = 0; axis < 3; ++axis) square += std::pow(mesh.positions[axis][i] - centres[cells[i]][axis], 2);
      error = std::max(error, std::sqrt(square));
    }
  }
};

// Faces that are not degenerate, without duplicates.
std::vector<int32_t> merge_faces(const Mesh& mesh, const Grid& grid, const std::vector<int32_t>& faces) {
  std::vector<CellTriangle> left;
  for (const int32_t face : faces) {
    std::array<int32_t, 3> cells;
    for (int corner = 0; corner < 3; ++corner) cells[corner] = grid.cells[mesh.corners[corner][face]];
    if (cells[0] == cells[1] || cells[1] == cells[2] || cells[2] == cells[0]) continue;
    std::rotate(cells.begin(), std::min_element(cells.begin(), cells.end()), cells.end());
    left.push_back({cells, face});
  }
  std::sort(left.begin(), left.end(), [](const CellTriangle& a, const CellTriangle& b) {
    return a.cells != b.cells ? a.cells < b.cells : a.face < b.face;
  });
  left.erase(std::unique(left.begin(), left.end(),
                         [](const CellTriangle& a, const CellTriangle& b) { return a.cells == b.cells; }),
             left.end());
  std::vector<int32_t> numbers;
  numbers.reserve(left.size());
  for (const CellTriangle& corners : left) numbers.push_back(corners.face);
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

// Each face's normal and texture planes are kept.
Mesh build_mesh(const Mesh& mesh, const Grid& grid, const std::vector<int32_t>& faces) {
  const auto padded = [](size_t count) { return (count + kMaxLanes - 1) / kMaxLanes * kMaxLanes; };
  Mesh merged;
  merged.low = mesh.low;
  merged.high = mesh.high;
  merged.vertex_count = static_cast<int32_t>(grid.centres.size());
  merged.face_count = static_cast<int32_t>(faces.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (const Vec3& centre : grid.centres) merged.positions[axis].push_back(static_cast<float>(centre[axis]));
    for (const int32_t face : faces) merged.corners[axis].push_back(grid.cells[mesh.corners[axis][face]]);
    merged.positions[axis].resize(padded(grid.centres.size()), 0.0f);
    merged.corners[axis].resize(padded(faces.size()), 0);
  }
  const auto copy = [&](const std::vector<float>& from, std::vector<float>& to, size_t width) {
    if (from.empty()) return;
    for (const int32_t face : faces)
      to.insert(to.end(), &from[width * static_cast<size_t>(face)], &from[width * static_cast<size_t>(face)] + width);
  };
  copy(mesh.normals, merged.normals, 4);
  copy(mesh.uv_planes, merged.uv_planes, 8);
  copy(mesh.normal_planes, merged.normal_planes, 12);
  return merged;
}

}  // namespace

std::vector<MeshLod> make_lods(const Mesh& mesh) {
  std::vector<MeshLod> levels;
  double extent = 0.0;
  for (int axis = 0; axis < 3; ++axis) extent = std::max(extent, mesh.high[axis] - mesh.low[axis]);
  if (mesh.face_count < kMinLodFaces || !(extent > 0.0) || !std::isfinite(extent)) return levels;
  std::vector<bool> used(static_cast<size_t>(mesh.vertex_count), false);
  for (const auto& corners : mesh.corners)
    for (int32_t face = 0; face < mesh.face_count; ++face) used[corners[face]] = true;
  std::vector<int32_t> faces(static_cast<size_t>(mesh.face_count));
  for (int32_t face = 0; face < mesh.face_count; ++face) faces[face] = face;
  size_t last = faces.size();
  for (int level = 0; level < kMaxLevels && last > kMinFaces; ++level) {
    const Grid grid(mesh, used, extent / kFinestGrid * (1 << level));
    faces = merge_faces(mesh, grid, faces);  // cells nest: a degenerate face stays so on coarser grids
    if (faces.empty()) break;
    if (faces.size() > last / 2) continue;
    levels.push_back({build_mesh(mesh, grid, faces), {}, grid.error});
    levels.back().triangles = levels.back().mesh.triangles();
    last = faces.size();
  }
  return levels;
}

}  // namespace trundle
