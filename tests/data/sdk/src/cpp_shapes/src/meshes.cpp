// Reads meshes, each named by an argument; `KIND:NAME` is read from memory. Prints vertices, triangles, corners of the
// box along the axes, and the volume, for each.
#include <geometric_shapes/mesh_operations.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

namespace {

std::unique_ptr<shapes::Mesh> read(const std::string& name) {
  const std::size_t colon = name.find(':');
  if (colon == std::string::npos || name.find("://") != std::string::npos)
    return std::unique_ptr<shapes::Mesh>(shapes::createMeshFromResource(name));
  std::ifstream file(name.substr(colon + 1), std::ios::binary);
  const std::string data{std::istreambuf_iterator<char>(file), {}};
  const Eigen::Vector3d scale(2.0, 2.0, 2.0);
  return std::unique_ptr<shapes::Mesh>(shapes::createMeshFromBinary(data.data(), data.size(), scale, name.substr(0, colon)));
}

Eigen::Vector3d corner(const shapes::Mesh& mesh, unsigned int i) {
  return Eigen::Map<const Eigen::Vector3d>(mesh.vertices + 3 * mesh.triangles[i]);
}

}  // namespace

int main(int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    const std::unique_ptr<shapes::Mesh> mesh = read(argv[i]);
    if (!mesh) {
      std::puts("none");
      continue;
    }
    Eigen::AlignedBox3d box;
    double volume = 0.0;
    for (unsigned int k = 0; k < mesh->triangle_count; ++k) {
      const Eigen::Vector3d a = corner(*mesh, 3 * k), b = corner(*mesh, 3 * k + 1), c = corner(*mesh, 3 * k + 2);
      volume += a.dot(b.cross(c)) / 6.0;
      box.extend(a).extend(b).extend(c);
    }
    const Eigen::Vector3d from = box.min(), to = box.max();
    std::printf("%u %u (%g %g %g) (%g %g %g) %g\n", mesh->vertex_count, mesh->triangle_count, from.x(), from.y(), from.z(),
                to.x(), to.y(), to.z(), volume);
  }
}
