// Meshes and textures, prepared for rendering.
#include "render/geometry.h"

#include <cmath>
#include <stdexcept>

#include <doctest/doctest.h>

using namespace trundle;

namespace {

const std::vector<float> kCorners = {0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0};

}  // namespace

TEST_CASE("a face has its outward normal, and one without area is dropped") {
  const Mesh mesh = make_mesh(kCorners, {0, 1, 2, 0, 1, 3, 1, 1, 1}, {}, {});
  REQUIRE(mesh.face_count == 1);
  CHECK(mesh.normals == std::vector<float>{0, 0, 1, 0});
  CHECK(mesh.low == Vec3{0, 0, 0});
  CHECK(mesh.high == Vec3{1, 1, 0});
}

TEST_CASE("arrays are padded to whole vectors") {
  const Mesh mesh = make_mesh(kCorners, {0, 1, 2}, {}, {});
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(mesh.positions[axis].size() % kMaxLanes == 0);
    CHECK(mesh.corners[axis].size() % kMaxLanes == 0);
  }
}

TEST_CASE("a face with a NaN is dropped") {
  CHECK(make_mesh({0, 0, 0, 1, 0, NAN, 0, 1, 0}, {0, 1, 2}, {}, {}).face_count == 0);
}

TEST_CASE("vertices that do not exist and arrays of other sizes are refused") {
  CHECK_THROWS_AS(make_mesh(kCorners, {0, 1, 4}, {}, {}), std::invalid_argument);
  CHECK_THROWS_AS(make_mesh(kCorners, {0, 1, -1}, {}, {}), std::invalid_argument);
  CHECK_THROWS_AS(make_mesh(kCorners, {0, 1, 2}, {0, 0}, {}), std::invalid_argument);
  CHECK_THROWS_AS(make_mesh(kCorners, {0, 1, 2}, {}, {0, 0, 1}), std::invalid_argument);
}

TEST_CASE("normals of corners are kept where they differ from the face's") {
  CHECK(make_mesh(kCorners, {0, 1, 2}, {}, {0, 0, 1, 0, 0, 1, 0, 0, 1}).normal_planes.empty());
  CHECK(make_mesh(kCorners, {0, 1, 2}, {}, {0, 0, 1, 0.6f, 0, 0.8f, 0, 0, 1}).normal_planes.size() == 12);
}

TEST_CASE("each level of a texture halves it, and repeats its first column and row") {
  const uint8_t rgb[3 * 4 * 2] = {10, 0, 0, 30, 0, 0, 50, 0, 0, 70, 0, 0, 10, 0, 0, 30, 0, 0, 50, 0, 0, 70, 0, 0};
  const Image image = make_image(rgb, 4, 2);
  const Texture& texture = image.texture;
  REQUIRE(texture.level_count == 3);
  const auto texel = [&](int level, int column, int row) {
    return image.texels[texture.start[level] + row * (texture.width[level] + 1) + column];
  };
  CHECK(texel(0, 4, 0) == texel(0, 0, 0));
  CHECK(texel(0, 1, 2) == texel(0, 1, 0));
  CHECK(texel(1, 0, 0) == 20);  // the mean of 10 and 30
  CHECK(texel(1, 1, 0) == 60);
  CHECK(texel(2, 0, 0) == 40);
  CHECK_THROWS_AS(make_image(rgb, 0, 2), std::invalid_argument);
}
