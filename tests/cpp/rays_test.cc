// Ranges of rays against the textbook's formulas.
#include <cmath>
#include <random>
#include <vector>

#include <doctest/doctest.h>

#include "render/renderer.h"

using namespace trundle;

namespace {

// Distance along a unit ray from the origin to a triangle, by Möller and Trumbore; infinity without a hit.
double distance(const Vec3& direction, const float* corners) {
  const auto corner = [&](int i) { return Vec3{corners[3 * i], corners[3 * i + 1], corners[3 * i + 2]}; };
  const auto minus = [](const Vec3& a, const Vec3& b) { return Vec3{a[0] - b[0], a[1] - b[1], a[2] - b[2]}; };
  const auto times = [](const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  const auto across = [](const Vec3& a, const Vec3& b) {
    return Vec3{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const Vec3 a = corner(0), ab = minus(corner(1), a), ac = minus(corner(2), a), p = across(direction, ac);
  const double determinant = times(ab, p);
  const Vec3 t = {-a[0], -a[1], -a[2]}, q = across(t, ab);
  const double u = times(t, p) / determinant, v = times(direction, q) / determinant;
  const double away = times(ac, q) / determinant;
  return u >= 0 && v >= 0 && u + v <= 1 && away > 0 ? away : INFINITY;
}

std::vector<double> random_directions(int count) {
  std::mt19937 source(3);
  std::normal_distribution<double> number;
  std::vector<double> directions;
  for (int i = 0; i < count; ++i) {
    const Vec3 v = {number(source), number(source), number(source)};
    const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (const double component : v) directions.push_back(component / length);
  }
  return directions;
}

}  // namespace

TEST_CASE("a mesh's ranges equal its triangles' one by one") {
  std::mt19937 source(11);
  std::uniform_real_distribution<float> place(-5.0f, 5.0f), offset(-0.8f, 0.8f);
  std::vector<float> vertices;
  std::vector<int32_t> faces;
  for (int face = 0; face < 400; ++face) {
    const float centre[3] = {place(source), place(source), place(source)};
    for (int corner = 0; corner < 3; ++corner) {
      faces.push_back(static_cast<int32_t>(faces.size()));
      for (const float coordinate : centre) vertices.push_back(coordinate + offset(source));
    }
  }
  SceneSpec scene;
  scene.bodies = 1;
  scene.meshes.push_back(make_mesh(vertices, faces, {}, {}));
  ShapeSpec shape;
  shape.kind = ShapeKind::kMesh;
  shape.mesh = 0;
  shape.body = 0;
  scene.shapes.push_back(shape);
  Renderer renderer(std::move(scene));
  const double pose[7] = {0, 0, 0, 1, 0, 0, 0};
  renderer.update(pose);
  const int count = 2000;
  const std::vector<double> directions = random_directions(count);
  std::vector<double> ranges(count);
  std::vector<int32_t> shapes(count);
  renderer.cast_rays({}, directions.data(), count, 100.0, -2, ranges.data(), shapes.data());
  int hits = 0, differing = 0;
  for (int ray = 0; ray < count; ++ray) {
    double nearest = INFINITY;
    for (size_t face = 0; face < vertices.size(); face += 9)
      nearest = std::min(
          nearest, distance({directions[3 * ray], directions[3 * ray + 1], directions[3 * ray + 2]}, &vertices[face]));
    hits += std::isfinite(nearest);
    const bool alike = std::isfinite(nearest) ? std::abs(ranges[ray] - nearest) < 1e-4 : ranges[ray] > 1e8;
    differing += !alike;  // a ray through an edge may go either way
  }
  CHECK(hits > count / 4);
  CHECK(differing <= 2);
}

TEST_CASE("a sphere's ranges are exact, and infinite beyond the limit") {
  SceneSpec scene;
  scene.bodies = 1;
  ShapeSpec shape;
  shape.kind = ShapeKind::kSphere;
  shape.size = {0.5f, 0.5f, 0.5f};
  shape.body = 0;
  scene.shapes.push_back(shape);
  Renderer renderer(std::move(scene));
  const double pose[7] = {3, 0, 0.3, 1, 0, 0, 0}, along[6] = {1, 0, 0, -1, 0, 0};
  renderer.update(pose);
  double ranges[2];
  int32_t shapes[2];
  renderer.cast_rays({}, along, 2, 10.0, -2, ranges, shapes);
  CHECK(ranges[0] == doctest::Approx(3 - std::sqrt(0.25 - 0.09)).epsilon(1e-7));
  CHECK(shapes[0] == 0);
  CHECK(std::isinf(ranges[1]));
  CHECK(shapes[1] == -1);
  renderer.cast_rays({}, along, 1, 2.0, -2, ranges, shapes);
  CHECK(std::isinf(ranges[0]));
}
