// Renders and ray casts random scenes with sizes of zero, infinity and NaN, broken meshes and cameras anywhere. Built
// with sanitizers by test_sanitized.py, which find every access out of bounds.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>
#include <stdexcept>

#include "../../../cpp/render/renderer.h"

using namespace trundle;

namespace {

std::mt19937 source;

int32_t whole(int32_t low, int32_t high) { return (int32_t)(low + (int64_t)(source() % (uint64_t)(high - low + 1))); }

double number() {
  switch (whole(0, 19)) {
    case 0: return 0.0;
    case 1: return std::numeric_limits<double>::quiet_NaN();
    case 2: return std::numeric_limits<double>::infinity();
    case 3: return -1e38;
    case 4: return 1e30;
    case 5: return 1e-30;
    default: return std::ldexp((double)whole(-1000, 1000), whole(-14, 0));
  }
}

double sane() { return whole(-3000, 3000) / 1000.0; }

std::array<float, 3> triple() { return {(float)number(), (float)number(), (float)number()}; }

// A random index; one in a hundred is out of range.
int32_t index(size_t count, int32_t least = 0) { return whole(least, (int32_t)count - (whole(0, 99) != 0)); }

Transform transform() {
  for (;;) {
    const bool wild = whole(0, 9) == 0;
    double pose[7];
    for (double& value : pose) value = wild ? number() : sane();
    if (const auto made = Transform::from_pose(pose)) return *made;
  }
}

Mesh mesh() {
  const int32_t vertex_count = whole(1, 40), face_count = whole(0, 120);
  std::vector<float> vertices, uv, normals;
  std::vector<int32_t> faces;
  const bool wild = whole(0, 4) == 0;
  for (int32_t i = 0; i < 3 * vertex_count; ++i) vertices.push_back((float)(wild ? number() : sane()));
  for (int32_t i = 0; i < 3 * face_count; ++i) faces.push_back(whole(0, 2000) ? whole(0, vertex_count - 1) : -1);
  if (whole(0, 1))
    for (int32_t i = 0; i < 6 * face_count; ++i) uv.push_back((float)(wild ? number() : sane()));
  if (whole(0, 1))
    for (int32_t i = 0; i < 9 * face_count; ++i) normals.push_back((float)(wild ? number() : sane()));
  return make_mesh(vertices, faces, uv, normals);
}

// Many small triangles, enough for levels of detail.
Mesh heavy() {
  const int32_t side = 150;
  std::vector<float> vertices;
  std::vector<int32_t> faces;
  const bool wild = whole(0, 1) == 0;
  for (int32_t i = 0; i < side * side; ++i) {
    vertices.insert(vertices.end(), {(float)(i % side) * 0.01f, (float)(i / side) * 0.01f, (float)sane() * 0.01f});
    if (wild && whole(0, 99) == 0) vertices.back() = (float)number();
    if (i % side == side - 1 || i / side == side - 1) continue;
    faces.insert(faces.end(), {i, i + 1, i + side, i + 1, i + side + 1, i + side});
  }
  return make_mesh(vertices, faces, {}, {});
}

Image image() {
  const int32_t width = whole(1, 40), height = whole(1, 40);
  std::vector<uint8_t> rgb;
  for (int32_t i = 0; i < 3 * width * height; ++i) rgb.push_back((uint8_t)whole(0, 255));
  return make_image(rgb.data(), width, height);
}

SceneSpec scene() {
  SceneSpec spec;
  spec.bodies = whole(1, 4);
  for (int32_t i = whole(1, 3); i > 0; --i) spec.meshes.push_back(whole(0, 19) ? mesh() : heavy());
  for (int32_t i = whole(0, 2); i > 0; --i) spec.textures.push_back(image());
  for (int32_t i = whole(0, 12); i > 0; --i) {
    MaterialSpec material{triple(),
                          triple(),
                          triple(),
                          triple(),
                          (float)number(),
                          whole(0, 2) ? 1.0f : (float)number(),
                          index(spec.textures.size(), -1),
                          {(float)number(), (float)number()}};
    spec.shapes.push_back({(ShapeKind)whole(0, 6),
                           index((size_t)spec.bodies),
                           index(spec.meshes.size()),
                           {number(), number(), number()},
                           transform(),
                           material,
                           whole(0, 1) == 1});
  }
  for (int32_t i = whole(0, 3); i > 0; --i) {
    LightSpec light;
    light.kind = (LightKind)whole(0, 2);
    light.body = index((size_t)spec.bodies, -1);
    light.position = {number(), number(), number()}, light.direction = {sane(), number(), sane()};
    light.diffuse = triple(), light.specular = triple();
    light.constant = (float)number(), light.linear = (float)number(), light.quadratic = (float)number();
    light.range = (float)number(), light.falloff = (float)number();
    light.inner_angle = (float)number(), light.outer_angle = (float)number();
    light.casts_shadows = whole(0, 1) == 1;
    spec.lights.push_back(light);
  }
  spec.ambient = triple();
  for (float* color : {spec.sky.horizon, spec.sky.zenith})
    for (int32_t i = 0; i < 3; ++i) color[i] = (float)number();
  spec.fog = {(FogKind)whole(0, 3), {0.5f, 0.5f, 0.5f}, (float)number(), (float)number(), (float)number()};
  return spec;
}

void draw(Renderer& renderer) {
  std::vector<double> poses;
  for (int32_t i = 0; i < 7 * renderer.bodies(); ++i) poses.push_back(whole(0, 40) ? sane() : number());
  renderer.update(poses.data());
  const int32_t count = whole(0, 4);
  std::vector<std::vector<uint8_t>> rgb(count);
  std::vector<std::vector<float>> depth(count);
  std::vector<std::vector<int32_t>> segmentation(count);
  std::vector<CameraTarget> targets;
  for (int32_t i = 0; i < count; ++i) {
    const int32_t width = whole(1, 70), height = whole(1, 50);
    const double near_ = std::ldexp(1.0, whole(-20, 4)), far_ = near_ * std::ldexp(1.5, whole(0, 40));
    const auto area = (size_t)(width * height);
    rgb[i].resize(3 * area), depth[i].resize(area), segmentation[i].resize(area);
    targets.push_back({transform(), width, height, std::ldexp(1.0, whole(-10, 20)), near_, far_, rgb[i].data(),
                       whole(0, 1) ? depth[i].data() : nullptr, whole(0, 1) ? segmentation[i].data() : nullptr});
  }
  renderer.render(targets);
  const int32_t rays = whole(0, 100);
  std::vector<double> directions, ranges((size_t)rays);
  std::vector<int32_t> shapes((size_t)rays);
  for (int32_t i = 0; i < 3 * rays; ++i) directions.push_back(whole(0, 30) ? sane() : number());
  renderer.cast_rays(transform(), directions.data(), (size_t)rays, std::fabs(number()), whole(-1, 4), ranges.data(),
                     shapes.data());
}

}  // namespace

int main(int, char** words) {
  const int32_t count = std::atoi(words[1]);
  int32_t drawn = 0;
  for (int32_t seed = 0; seed < count; ++seed) {
    source.seed((uint32_t)seed);
    try {
      Renderer renderer(scene(), whole(1, 3));
      draw(renderer);
      if (whole(0, 3) == 0) renderer.set_mesh(index(1), mesh());
      draw(renderer);
      ++drawn;
    } catch (const std::invalid_argument&) {  // an index out of range
    }
  }
  std::printf("%d drawn\n", drawn);
}
