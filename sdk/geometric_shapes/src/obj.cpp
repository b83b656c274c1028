// Wavefront OBJ: faces of all objects; lines, points and materials are skipped.
#include <cstdlib>
#include <locale>
#include <sstream>

#include "mesh_files.h"

namespace shapes {
namespace files {
namespace {

/** Vertex of a corner such as `7/1/3`; a negative number counts backwards from the last. */
const Eigen::Vector3d& vertexOf(const std::string& corner, const Triangles& vertices, std::size_t line) {
  char* end = nullptr;
  const long long number = std::strtoll(corner.c_str(), &end, 10), count = static_cast<long long>(vertices.size());
  const long long index = number > 0 ? number - 1 : count + number;
  if (end == corner.c_str() || (*end != '\0' && *end != '/') || number == 0 || index < 0 || index >= count)
    throw std::runtime_error("line " + std::to_string(line) + ": a face names vertex '" + corner + "' of " +
                             std::to_string(count));
  return vertices[static_cast<std::size_t>(index)];
}

}  // namespace

Triangles readObj(const std::string& data) {
  std::istringstream file(data), words;
  words.imbue(std::locale::classic());
  Triangles vertices, points;
  std::string text, rest, word;
  for (std::size_t line = 1; std::getline(file, text); ++line) {
    while (text.find_last_of('\\') != std::string::npos &&
           text.find_first_not_of(" \t\r", text.find_last_of('\\') + 1) == std::string::npos &&
           std::getline(file, rest)) {
      ++line;
      text.replace(text.find_last_of('\\'), std::string::npos, " " + rest);
    }
    words.clear();
    words.str(text);
    if (!(words >> word)) continue;
    if (word == "v") {
      Eigen::Vector3d vertex;
      if (!(words >> vertex.x() >> vertex.y() >> vertex.z()))
        throw std::runtime_error("line " + std::to_string(line) + ": a vertex has no three numbers");
      vertices.push_back(vertex);
    } else if (word == "f") {
      Triangles corners;
      while (words >> word) corners.push_back(vertexOf(word, vertices, line));
      for (std::size_t i = 2; i < corners.size(); ++i)
        points.insert(points.end(), {corners[0], corners[i - 1], corners[i]});
    }
  }
  return points;
}

}  // namespace files
}  // namespace shapes
