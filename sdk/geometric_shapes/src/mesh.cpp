#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <vector>

#include "geometric_shapes/shapes.h"

namespace shapes {
namespace {

using Vectors = Eigen::Map<Eigen::Matrix3Xd>;
using Cell = std::tuple<long long, long long, long long>;

template <typename T>
T* copied(const T* values, std::size_t count) {
  if (values == nullptr) return nullptr;
  T* copy = new T[count];
  std::copy(values, values + count, copy);
  return copy;
}

double angleBetween(const Eigen::Vector3d& one, const Eigen::Vector3d& other) {
  return std::atan2(one.cross(other).norm(), one.dot(other));
}

}  // namespace

Mesh::Mesh()
    : vertex_count(0),
      vertices(nullptr),
      triangle_count(0),
      triangles(nullptr),
      triangle_normals(nullptr),
      vertex_normals(nullptr) {
  type = MESH;
}

Mesh::Mesh(unsigned int v_count, unsigned int t_count)
    : vertex_count(v_count),
      vertices(new double[std::size_t{3} * v_count]()),
      triangle_count(t_count),
      triangles(new unsigned int[std::size_t{3} * t_count]()),
      triangle_normals(new double[std::size_t{3} * t_count]()),
      vertex_normals(new double[std::size_t{3} * v_count]()) {
  type = MESH;
}

Mesh::Mesh(const Mesh& other)
    : Shape(other),
      vertex_count(other.vertex_count),
      vertices(copied(other.vertices, std::size_t{3} * vertex_count)),
      triangle_count(other.triangle_count),
      triangles(copied(other.triangles, std::size_t{3} * triangle_count)),
      triangle_normals(copied(other.triangle_normals, std::size_t{3} * triangle_count)),
      vertex_normals(copied(other.vertex_normals, std::size_t{3} * vertex_count)) {}

Mesh::~Mesh() {
  delete[] vertices;
  delete[] triangles;
  delete[] triangle_normals;
  delete[] vertex_normals;
}

void Mesh::scaleAndPadd(double scaleX, double scaleY, double scaleZ, double paddX, double paddY, double paddZ) {
  if (vertex_count == 0) return;
  if (vertex_normals == nullptr) computeVertexNormals();
  Vectors points(vertices, 3, vertex_count);
  const Vectors normals(vertex_normals, 3, vertex_count);
  const Eigen::Vector3d middle = points.rowwise().mean(), scale(scaleX, scaleY, scaleZ), padd(paddX, paddY, paddZ);
  points = (scale.asDiagonal() * (points.colwise() - middle)).colwise() + middle;
  points += padd.asDiagonal() * normals;
}

void Mesh::print(std::ostream& out) const {
  out << "Mesh[vertices=" << vertex_count << ", triangles=" << triangle_count << "]" << std::endl;
}

void Mesh::computeTriangleNormals() {
  if (triangle_normals == nullptr) triangle_normals = new double[std::size_t{3} * triangle_count];
  const Vectors points(vertices, 3, vertex_count);
  Vectors normals(triangle_normals, 3, triangle_count);
  for (unsigned int i = 0; i < triangle_count; ++i) {
    const unsigned int* corner = triangles + std::size_t{3} * i;
    const Eigen::Vector3d first = points.col(corner[0]);
    normals.col(i) = (points.col(corner[1]) - first).cross(points.col(corner[2]) - first).stableNormalized();
  }
}

void Mesh::computeVertexNormals() {
  if (triangle_normals == nullptr) computeTriangleNormals();
  if (vertex_normals == nullptr) vertex_normals = new double[std::size_t{3} * vertex_count];
  const Vectors points(vertices, 3, vertex_count), faces(triangle_normals, 3, triangle_count);
  Vectors normals(vertex_normals, 3, vertex_count);
  normals.setZero();
  for (unsigned int i = 0; i < triangle_count; ++i) {
    const unsigned int* corner = triangles + std::size_t{3} * i;
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d at = points.col(corner[k]);
      const double angle = angleBetween(points.col(corner[(k + 1) % 3]) - at, points.col(corner[(k + 2) % 3]) - at);
      normals.col(corner[k]) += angle * faces.col(i);
    }
  }
  for (unsigned int i = 0; i < vertex_count; ++i) normals.col(i).stableNormalize();
}

void Mesh::mergeVertices(double threshold) {
  // Vertices by cubes with sides of the threshold: those near enough lie in neighbouring cubes.
  const Vectors points(vertices, 3, vertex_count);
  const double side = threshold > 0.0 ? threshold : 1.0;
  std::map<Cell, std::vector<unsigned int>> cells;
  std::vector<unsigned int> kept, number(vertex_count);
  for (unsigned int i = 0; i < vertex_count; ++i) {
    const Eigen::Matrix<long long, 3, 1> cell = (points.col(i) / side).array().floor().matrix().cast<long long>();
    bool is_merged = false;
    for (int k = 0; k < 27 && !is_merged; ++k) {
      const auto found = cells.find(Cell(cell[0] + k % 3 - 1, cell[1] + k / 3 % 3 - 1, cell[2] + k / 9 - 1));
      if (found == cells.end()) continue;
      for (const unsigned int other : found->second) {
        if ((points.col(i) - points.col(kept[other])).norm() > threshold) continue;
        number[i] = other;
        is_merged = true;
        break;
      }
    }
    if (is_merged) continue;
    number[i] = static_cast<unsigned int>(kept.size());
    cells[Cell(cell[0], cell[1], cell[2])].push_back(number[i]);
    kept.push_back(i);
  }
  if (kept.size() == vertex_count) return;
  double* merged = new double[3 * kept.size()];
  for (std::size_t i = 0; i < kept.size(); ++i) std::copy_n(vertices + std::size_t{3} * kept[i], 3, merged + 3 * i);
  delete[] vertices;
  vertices = merged;
  vertex_count = static_cast<unsigned int>(kept.size());
  for (std::size_t i = 0; i < std::size_t{3} * triangle_count; ++i) triangles[i] = number[triangles[i]];
  if (triangle_normals != nullptr) computeTriangleNormals();
  if (vertex_normals != nullptr) computeVertexNormals();
}

}  // namespace shapes
