// STL: binary, or text.
#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <locale>
#include <sstream>

#include "geometric_shapes/mesh_operations.h"
#include "mesh_files.h"

namespace shapes {
namespace files {
namespace {

constexpr std::size_t kHeader = 84, kTriangle = 50, kNormal = 12;  // [B]

bool startsAsText(const std::string& data) {
  const std::size_t first = data.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) return false;
  std::string word = data.substr(first, 5);
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::tolower(c); });
  return word == "solid";
}

Triangles readBinary(const std::string& data, std::size_t count) {
  Triangles points;
  points.reserve(3 * count);  // the file has that many
  for (std::size_t i = 0; i < count; ++i) {
    float values[9];
    std::memcpy(values, data.data() + kHeader + i * kTriangle + kNormal, sizeof values);
    for (int k = 0; k < 3; ++k) points.emplace_back(values[3 * k], values[3 * k + 1], values[3 * k + 2]);
  }
  return points;
}

Triangles readText(const std::string& data) {
  std::istringstream in(data);
  in.imbue(std::locale::classic());
  std::string word;
  std::getline(in, word);  // the name, which may be any words
  Triangles points;
  while (in >> word) {
    if (word != "vertex" && word != "VERTEX") continue;
    Eigen::Vector3d point;
    if (!(in >> point.x() >> point.y() >> point.z()))
      throw std::runtime_error("vertex " + std::to_string(points.size() + 1) + " has no three numbers");
    points.push_back(point);
  }
  if (points.size() % 3 != 0) throw std::runtime_error("it ends inside a triangle");
  return points;
}

}  // namespace

Triangles readStl(const std::string& data) {
  // Many binary files start with `solid`, so the size decides.
  const bool is_text = startsAsText(data);
  std::uint32_t count = 0;
  if (data.size() >= kHeader) std::memcpy(&count, data.data() + kHeader - sizeof count, sizeof count);
  const std::size_t available = data.size() < kHeader ? 0 : (data.size() - kHeader) / kTriangle;
  const bool is_whole = data.size() == kHeader + kTriangle * std::size_t{count};
  if (count > 0 && (is_whole || (count <= available && !is_text))) return readBinary(data, count);
  if (is_text) return readText(data);
  throw std::runtime_error("it declares " + std::to_string(count) + " triangles and contains " +
                           std::to_string(available));
}

}  // namespace files

void writeSTLBinary(const Mesh* mesh, std::vector<char>& buffer) {
  using namespace files;
  buffer.assign(kHeader + kTriangle * std::size_t{mesh->triangle_count}, '\0');
  const std::uint32_t count = mesh->triangle_count;
  std::memcpy(buffer.data() + kHeader - sizeof count, &count, sizeof count);
  for (std::size_t i = 0; i < count; ++i) {
    float values[12] = {};
    for (std::size_t k = 0; k < 3; ++k) {
      if (mesh->triangle_normals != nullptr) values[k] = static_cast<float>(mesh->triangle_normals[3 * i + k]);
      const double* corner = mesh->vertices + std::size_t{3} * mesh->triangles[3 * i + k];
      for (std::size_t n = 0; n < 3; ++n) values[3 + 3 * k + n] = static_cast<float>(corner[n]);
    }
    std::memcpy(buffer.data() + kHeader + kTriangle * i, values, sizeof values);
  }
}

}  // namespace shapes
