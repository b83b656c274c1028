#pragma once

#include <cstddef>
#include <string>

namespace urdf {

/** Shallow enough for the reader of XML, which calls itself for each element; comments count as well, but no robot is
 * near the limit. */
inline bool isShallow(const std::string& xml) {
  constexpr size_t kMaxDepth = 100;
  size_t depth = 0;
  for (size_t i = 0; i + 1 < xml.size(); ++i) {
    const bool is_end = (xml[i] == '<' && xml[i + 1] == '/') || (xml[i] == '/' && xml[i + 1] == '>');
    const bool is_start = xml[i] == '<' && xml[i + 1] != '/' && xml[i + 1] != '!' && xml[i + 1] != '?';
    if (is_start && ++depth > kMaxDepth) return false;
    if (is_end && depth > 0) --depth;
  }
  return true;
}

}  // namespace urdf
