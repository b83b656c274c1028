// Readers of files of meshes: each returns three points for each triangle, or throws std::runtime_error.
#pragma once

#include <eigen_stl_containers/eigen_stl_vector_container.h>

#include <stdexcept>
#include <string>

namespace shapes {
namespace files {

using Triangles = EigenSTL::vector_Vector3d;

/** Of a file that names one geometry often. */
constexpr std::size_t kMaxTriangles = 20'000'000;

Triangles readStl(const std::string& data);
Triangles readObj(const std::string& data);
Triangles readCollada(const std::string& data);

}  // namespace files
}  // namespace shapes
