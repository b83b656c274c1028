#include "mesh_edges.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "vector3.h"

namespace trundle {

namespace {

constexpr double kNear =
    1e-6;  // smallest distance of a face's plane from the origin, relative to the largest, with which there is a bound

std::int64_t start_of(const MeshView& mesh, std::int64_t side) { return mesh.faces[side]; }
std::int64_t end_of(const MeshView& mesh, std::int64_t side) { return mesh.faces[side % 3 == 2 ? side - 2 : side + 1]; }
Vector3 point_of(const MeshView& mesh, std::int64_t point) { return vector_at(mesh.points + 3 * point); }

Vector3 normal_of(const MeshView& mesh, std::size_t face) {
  const std::int64_t* corners = mesh.faces + 3 * face;
  const Vector3 a = point_of(mesh, corners[0]);
  return cross(point_of(mesh, corners[1]) - a, point_of(mesh, corners[2]) - a);
}

// Number of faces that the ray from the origin through the middle of the first face meets.
int faces_on_a_ray(const MeshView& mesh) {
  Vector3 ray{};
  for (int i = 0; i < 3; ++i) {
    const Vector3 corner = point_of(mesh, mesh.faces[i]);
    for (int k = 0; k < 3; ++k) ray[k] += corner[k] / 3;
  }
  const bool is_along_x = std::abs(ray[0]) >= 0.9 * length(ray);
  const Vector3 right = cross(ray, is_along_x ? Vector3{0, 1, 0} : Vector3{1, 0, 0});
  const Vector3 up = cross(ray, right);
  struct Projected {
    double x, y, along;
  };
  std::vector<Projected> projected(mesh.point_count);
  for (std::size_t i = 0; i < mesh.point_count; ++i) {
    const Vector3 point = point_of(mesh, static_cast<std::int64_t>(i));
    projected[i] = {dot(point, right), dot(point, up), dot(point, ray)};
  }
  int met = 0;
  for (std::size_t face = 0; face < mesh.face_count; ++face) {
    const std::int64_t* corners = mesh.faces + 3 * face;
    const Projected a = projected[corners[0]], b = projected[corners[1]], c = projected[corners[2]];
    if (!(a.along > 0 && b.along > 0 && c.along > 0)) continue;
    const double u = a.x * b.y - a.y * b.x, v = b.x * c.y - b.y * c.x, w = c.x * a.y - c.y * a.x;
    met += (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
  }
  return met;
}

}  // namespace

std::vector<std::int64_t> component_labels(const MeshView& mesh) {
  std::vector<std::int64_t> labels(mesh.point_count);
  for (std::size_t i = 0; i < labels.size(); ++i) labels[i] = static_cast<std::int64_t>(i);
  const auto root_of = [&](std::int64_t point) {
    while (labels[point] != point) point = labels[point] = labels[labels[point]];
    return point;
  };
  for (std::size_t side = 0; side < 3 * mesh.face_count; ++side) {
    const auto number = static_cast<std::int64_t>(side);
    const std::int64_t a = root_of(start_of(mesh, number)), b = root_of(end_of(mesh, number));
    labels[std::max(a, b)] = std::min(a, b);
  }
  for (std::int64_t& label : labels) label = labels[label];  // ascending: every parent is a root by now
  return labels;
}

std::vector<std::int64_t> sides_by_edge(const MeshView& mesh) {
  const std::size_t count = 3 * mesh.face_count;
  if (count % 2) return {};
  std::vector<std::size_t> ends(mesh.point_count + 1, 0);  // start of the sides of each smaller point
  for (std::size_t side = 0; side < count; ++side) {
    const auto number = static_cast<std::int64_t>(side);
    ++ends[std::min(start_of(mesh, number), end_of(mesh, number)) + 1];
  }
  for (std::size_t i = 1; i < ends.size(); ++i) ends[i] += ends[i - 1];
  std::vector<std::pair<std::int64_t, std::int64_t>> sorted(count);  // larger point, side
  for (std::size_t side = 0; side < count; ++side) {
    const auto number = static_cast<std::int64_t>(side);
    const auto [low, high] = std::minmax({start_of(mesh, number), end_of(mesh, number)});
    sorted[ends[low]++] = {high, number};
  }
  std::vector<std::int64_t> sides(count);
  std::size_t first = 0;
  for (std::size_t point = 0; point < mesh.point_count; ++point) {
    const std::size_t last = ends[point];
    if ((last - first) % 2) return {};
    std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(first), sorted.begin() + static_cast<std::ptrdiff_t>(last));
    for (std::size_t i = first; i < last; i += 2) {
      if (sorted[i].first != sorted[i + 1].first) return {};
      if (i > first && sorted[i].first == sorted[i - 1].first) return {};
      sides[i] = sorted[i].second;
      sides[i + 1] = sorted[i + 1].second;
    }
    first = last;
  }
  return sides;
}

std::vector<double> double_areas(const MeshView& mesh) {
  std::vector<double> areas(mesh.face_count);
  for (std::size_t face = 0; face < areas.size(); ++face) areas[face] = length(normal_of(mesh, face));
  return areas;
}

double fold_height(const MeshView& mesh, const std::vector<std::int64_t>& sides) {
  constexpr double kUnbounded = std::numeric_limits<double>::infinity();
  std::vector<Vector3> gradients(mesh.face_count);
  std::vector<bool> is_flipped(mesh.face_count);
  double lowest = kUnbounded, highest = 0.0;
  for (std::size_t face = 0; face < mesh.face_count; ++face) {
    Vector3 normal = normal_of(mesh, face);
    normal = normal * (1 / length(normal));
    const double offset = dot(normal, point_of(mesh, mesh.faces[3 * face]));
    is_flipped[face] = offset < 0;
    gradients[face] = normal * (1 / offset);
    lowest = std::min(lowest, std::abs(offset));
    highest = std::max(highest, std::abs(offset));
  }
  if (!(lowest > kNear * highest) || std::find(is_flipped.begin(), is_flipped.end(), false) == is_flipped.end())
    return kUnbounded;
  double excess = 0.0;
  for (std::size_t i = 0; i < sides.size(); i += 2) {
    const std::int64_t first = sides[i] / 3, second = sides[i + 1] / 3;
    const std::int64_t start = start_of(mesh, sides[i]), end = end_of(mesh, sides[i]);
    if ((start == start_of(mesh, sides[i + 1])) != (is_flipped[first] != is_flipped[second])) return kUnbounded;
    const Vector3 across = cross(point_of(mesh, start), point_of(mesh, end));
    const double fold = dot(gradients[second] - gradients[first], across) / length(across);
    excess += std::max(is_flipped[first] ? -fold : fold, 0.0);
  }
  if (faces_on_a_ray(mesh) != 1) return kUnbounded;
  double farthest = 0.0;
  for (std::size_t i = 0; i < mesh.point_count; ++i)
    farthest = std::max(farthest, length(point_of(mesh, static_cast<std::int64_t>(i))));
  return excess * farthest * highest;
}

}  // namespace trundle
