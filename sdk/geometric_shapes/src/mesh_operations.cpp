#include "geometric_shapes/mesh_operations.h"

#include <resource_retriever/retriever.h>
#include <ros/console.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <limits>
#include <unordered_map>

#include "mesh_files.h"

namespace shapes {
namespace {

const Eigen::Vector3d kUnscaled(1.0, 1.0, 1.0);

struct PointHash {
  std::size_t operator()(const Eigen::Vector3d& point) const {
    std::size_t hash = 0;
    for (int i = 0; i < 3; ++i) hash = hash * 1'000'003 + std::hash<double>()(point[i]);
    return hash;
  }
};

/** Extension of a file's name, in small letters; a name without a dot is one. */
std::string extension(const std::string& name) {
  std::string result = name.substr(name.find_last_of('.') + 1);
  std::transform(result.begin(), result.end(), result.begin(), [](unsigned char c) { return std::tolower(c); });
  return result;
}

files::Triangles read(const std::string& data, const std::string& kind) {
  if (kind == "stl" || kind == "stlb") return files::readStl(data);
  if (kind == "obj") return files::readObj(data);
  if (kind == "dae") return files::readCollada(data);
  const std::string head = data.substr(0, 4096);
  if (head.find("<COLLADA") != std::string::npos) return files::readCollada(data);
  if (head.find("\nv ") != std::string::npos || head.compare(0, 2, "v ") == 0) return files::readObj(data);
  try {
    return files::readStl(data);
  } catch (const std::runtime_error&) {
    throw std::runtime_error("Trundle's development kit reads STL, OBJ and COLLADA");
  }
}

}  // namespace

Mesh* createMeshFromVertices(const EigenSTL::vector_Vector3d& vertices, const std::vector<unsigned int>& triangles) {
  const bool is_too_large = std::max(vertices.size(), triangles.size()) > std::numeric_limits<unsigned int>::max();
  const bool is_outside =
      std::any_of(triangles.begin(), triangles.end(), [&](unsigned int corner) { return corner >= vertices.size(); });
  if (is_too_large || is_outside) {
    ROS_ERROR("Cannot make a mesh: %s",
              is_outside ? "a triangle names a vertex that is not there" : "there are too many vertices");
    return nullptr;
  }
  Mesh* mesh = new Mesh(static_cast<unsigned int>(vertices.size()), static_cast<unsigned int>(triangles.size() / 3));
  for (std::size_t i = 0; i < vertices.size(); ++i) Eigen::Map<Eigen::Vector3d>(mesh->vertices + 3 * i) = vertices[i];
  std::copy_n(triangles.begin(), std::size_t{3} * mesh->triangle_count, mesh->triangles);
  mesh->computeTriangleNormals();
  mesh->computeVertexNormals();
  return mesh;
}

Mesh* createMeshFromVertices(const EigenSTL::vector_Vector3d& source) {
  if (source.size() < 3) return nullptr;
  if (source.size() % 3 != 0)
    ROS_ERROR("The number of vertices of a mesh is not divisible by 3; the last are left out");
  EigenSTL::vector_Vector3d vertices;
  std::vector<unsigned int> triangles;
  std::unordered_map<Eigen::Vector3d, unsigned int, PointHash, std::equal_to<Eigen::Vector3d>,
                     Eigen::aligned_allocator<std::pair<const Eigen::Vector3d, unsigned int>>>
      known;
  triangles.reserve(source.size());
  for (std::size_t i = 0; i < source.size() - source.size() % 3; ++i) {
    const Eigen::Vector3d point = source[i].array() + 0.0;  // -0 and 0 are one
    const auto [found, is_new] = known.emplace(point, static_cast<unsigned int>(vertices.size()));
    if (is_new) vertices.push_back(point);
    triangles.push_back(found->second);
  }
  return createMeshFromVertices(vertices, triangles);
}

Mesh* createMeshFromBinary(const char* buffer, std::size_t size, const std::string& assimp_hint) {
  return createMeshFromBinary(buffer, size, kUnscaled, assimp_hint);
}

Mesh* createMeshFromBinary(const char* buffer, std::size_t size, const Eigen::Vector3d& scale,
                           const std::string& assimp_hint) {
  const std::string of = assimp_hint.empty() ? "" : " '" + assimp_hint + "'";
  if (buffer == nullptr || size == 0) {
    ROS_ERROR("Cannot read mesh%s: it is empty", of.c_str());
    return nullptr;
  }
  try {
    files::Triangles points = read(std::string(buffer, size), extension(assimp_hint));
    if (points.empty()) throw std::runtime_error("it has no triangles");
    for (Eigen::Vector3d& point : points) {
      point = point.cwiseProduct(scale).eval();
      if (!point.allFinite()) throw std::runtime_error("a number of it is not finite");
    }
    return createMeshFromVertices(points);
  } catch (const std::exception& error) {  // bad_alloc, too
    ROS_ERROR("Cannot read mesh%s: %s", of.c_str(), error.what());
    return nullptr;
  }
}

Mesh* createMeshFromResource(const std::string& resource) { return createMeshFromResource(resource, kUnscaled); }

Mesh* createMeshFromResource(const std::string& resource, const Eigen::Vector3d& scale) {
  try {
    const resource_retriever::MemoryResource file = resource_retriever::Retriever().get(resource);
    return createMeshFromBinary(reinterpret_cast<const char*>(file.data.get()), file.size, scale, resource);
  } catch (const resource_retriever::Exception& error) {
    ROS_ERROR("%s", error.what());
    return nullptr;
  }
}

}  // namespace shapes
