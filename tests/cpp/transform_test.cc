// Rigid transforms, and the pixels that a box may cover.
#include "render/transform.h"

#include <cmath>

#include <doctest/doctest.h>

using namespace trundle;

namespace {

constexpr View kView{100, 80, 112, 50.0f, 40.0f, 60.0f, 0.1f, 100.0f, false};

Transform at(double x, double y, double z) { return {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {x, y, z}}; }

bool contains(const Rectangle& outer, double u, double v) {
  return outer.left <= u && u < outer.right && outer.top <= v && v < outer.bottom;
}

}  // namespace

TEST_CASE("a transform times its inverse is the identity") {
  const double pose[7] = {1.0, -2.0, 3.0, 0.9, 0.1, -0.3, 0.2};
  const Transform world_from_a = *Transform::from_pose(pose);
  const Transform identity = world_from_a * world_from_a.inverse();
  for (int i = 0; i < 9; ++i) CHECK(identity.rotation[i] == doctest::Approx(i % 4 == 0 ? 1.0 : 0.0));
  for (const double coordinate : identity.position) CHECK(coordinate == doctest::Approx(0.0));
}

TEST_CASE("a quaternion of any length gives the same rotation, and none of length zero or with a NaN") {
  const double longer[7] = {0, 0, 0, 2.0, 0, 0, 2.0}, unit[7] = {0, 0, 0, std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
  const Vec3 turned = Transform::from_pose(longer)->rotate({1, 0, 0});
  const Vec3 expected = Transform::from_pose(unit)->rotate({1, 0, 0});
  for (int i = 0; i < 3; ++i) CHECK(turned[i] == doctest::Approx(expected[i]));
  CHECK(turned[1] == doctest::Approx(1.0));
  const double zero[7] = {}, nan[7] = {0, NAN, 0, 1, 0, 0, 0};
  CHECK_FALSE(Transform::from_pose(zero));
  CHECK_FALSE(Transform::from_pose(nan));
}

TEST_CASE("a box ahead covers the projections of its corners") {
  const Rectangle bounds = screen_bounds(kView, at(5.0, 1.0, -0.5), {-1, -1, -1}, {1, 1, 1});
  CHECK(bounds.min_depth == doctest::Approx(4.0));
  for (int i = 0; i < 8; ++i) {
    const double x = i & 1 ? 6 : 4, y = i & 2 ? 2 : 0, z = i & 4 ? 0.5 : -1.5;
    CHECK(contains(bounds, 50 - 60 * y / x, 40 - 60 * z / x));
  }
  CHECK(bounds.left > 0);
  CHECK(bounds.right < 100);
}

TEST_CASE("a box across the near plane covers its part in front") {
  const Rectangle bounds = screen_bounds(kView, at(0.0, 0.05, 0.0), {-1, -0.01, -0.01}, {1, 0.01, 0.01});
  CHECK(contains(bounds, 50 - 60 * 0.05 / 0.1, 40));  // its nearest visible part
  CHECK(contains(bounds, 50 - 60 * 0.05 / 1.0, 40));  // its far end
  CHECK(bounds.left > 0);
}

TEST_CASE("a box behind the camera covers no pixels, and one with a NaN the whole image") {
  CHECK(screen_bounds(kView, at(-5.0, 0.0, 0.0), {-1, -1, -1}, {1, 1, 1}).empty());
  const Rectangle bounds = screen_bounds(kView, at(5.0, NAN, 0.0), {-1, -1, -1}, {1, 1, 1});
  CHECK((bounds.empty() || (bounds.left == 0 && bounds.right == 100)));
}
