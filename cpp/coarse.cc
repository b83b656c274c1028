#include "coarse.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

namespace trundle {

namespace {

constexpr int kLevels = 6;
constexpr size_t kFew = 500;  // faces, below which nothing is gained

struct Corners {
  std::array<int32_t, 3> cells;  // the least one first, in their order around the face
  int32_t face;
};

// Each cell's number in the order in which vertices come to it, and the middle of those.
struct Grid {
  std::vector<int32_t> cells;  // of each vertex
  std::vector<Vec3> middles;
  double off = 0.0;

  Grid(const Mesh& mesh, const std::vector<bool>& used, double width) : cells((size_t)mesh.vertex_count, -1) {
    std::unordered_map<int64_t, int32_t> numbers;
    std::vector<int32_t> counts;
    for (int32_t i = 0; i < mesh.vertex_count; ++i) {
      if (!used[i]) continue;
      int64_t key = 0;
      for (int axis = 0; axis < 3; ++axis)
        key = key << 20 | (int64_t)std::clamp((mesh.places[axis][i] - mesh.low[axis]) / width, 0.0, kFinest);
      const int32_t cell = cells[i] = numbers.try_emplace(key, (int32_t)middles.size()).first->second;
      if (cell == (int32_t)middles.size()) middles.push_back({}), counts.push_back(0);
      for (int axis = 0; axis < 3; ++axis) middles[cell][axis] += mesh.places[axis][i];
      ++counts[cell];
    }
    for (size_t cell = 0; cell < middles.size(); ++cell)
      for (double& place : middles[cell]) place /= counts[cell];
    for (int32_t i = 0; i < mesh.vertex_count; ++i) {
      if (!used[i]) continue;
      double square = 0.0;
      for (int axis = 0; axis < 3; ++axis) square += std::pow(mesh.places[axis][i] - middles[cells[i]][axis], 2);
      off = std::max(off, std::sqrt(square));
    }
  }
};

// Those faces that are still some, each once.
std::vector<int32_t> kept(const Mesh& mesh, const Grid& grid, const std::vector<int32_t>& faces) {
  std::vector<Corners> left;
  for (const int32_t face : faces) {
    std::array<int32_t, 3> cells;
    for (int corner = 0; corner < 3; ++corner) cells[corner] = grid.cells[mesh.corners[corner][face]];
    if (cells[0] == cells[1] || cells[1] == cells[2] || cells[2] == cells[0]) continue;
    std::rotate(cells.begin(), std::min_element(cells.begin(), cells.end()), cells.end());
    left.push_back({cells, face});
  }
  std::sort(left.begin(), left.end(), [](const Corners& a, const Corners& b) {
    return a.cells != b.cells ? a.cells < b.cells : a.face < b.face;
  });
  left.erase(std::unique(left.begin(), left.end(), [](const Corners& a, const Corners& b) { return a.cells == b.cells; }),
             left.end());
  std::vector<int32_t> numbers;
  for (const Corners& corners : left) numbers.push_back(corners.face);
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

// What runs over a face, its light and its texture, stays as it was.
Mesh gathered(const Mesh& mesh, const Grid& grid, const std::vector<int32_t>& faces) {
  const auto padded = [](size_t count) { return (count + kWidest - 1) / kWidest * kWidest; };
  Mesh made;
  made.low = mesh.low, made.high = mesh.high;
  made.vertex_count = (int32_t)grid.middles.size(), made.face_count = (int32_t)faces.size();
  for (int axis = 0; axis < 3; ++axis) {
    for (const Vec3& middle : grid.middles) made.places[axis].push_back((float)middle[axis]);
    for (const int32_t face : faces) made.corners[axis].push_back(grid.cells[mesh.corners[axis][face]]);
    made.places[axis].resize(padded(grid.middles.size()), 0.0f);
    made.corners[axis].resize(padded(faces.size()), 0);
  }
  const auto copy = [&](const std::vector<float>& from, std::vector<float>& to, size_t width) {
    if (from.empty()) return;
    for (const int32_t face : faces) to.insert(to.end(), &from[width * (size_t)face], &from[width * (size_t)face] + width);
  };
  copy(mesh.normals, made.normals, 4), copy(mesh.layout, made.layout, 8), copy(mesh.bend, made.bend, 12);
  return made;
}

}  // namespace

std::vector<Coarse> coarser(const Mesh& mesh) {
  std::vector<Coarse> levels;
  double extent = 0.0;
  for (int axis = 0; axis < 3; ++axis) extent = std::max(extent, mesh.high[axis] - mesh.low[axis]);
  if (mesh.face_count < kHeavy || !(extent > 0.0) || !std::isfinite(extent)) return levels;
  std::vector<bool> used((size_t)mesh.vertex_count, false);
  for (const auto& corners : mesh.corners)
    for (int32_t face = 0; face < mesh.face_count; ++face) used[corners[face]] = true;
  std::vector<int32_t> faces((size_t)mesh.face_count);
  for (int32_t face = 0; face < mesh.face_count; ++face) faces[face] = face;
  size_t last = faces.size();
  for (int level = 0; level < kLevels && last > kFew; ++level) {
    const Grid grid(mesh, used, extent / kFinest * (1 << level));
    faces = kept(mesh, grid, faces);  // cells lie within those of wider grids: what is gone stays gone
    if (faces.empty()) break;
    if (faces.size() > last / 2) continue;
    levels.push_back({gathered(mesh, grid, faces), {}, grid.off});
    levels.back().triangles = levels.back().mesh.triangles();
    last = faces.size();
  }
  return levels;
}

}  // namespace trundle
