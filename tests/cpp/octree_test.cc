// Cubes in space: rays, streams, bounds.
#include "navigation/occupancy_tree.h"

#include <cmath>
#include <vector>

#include <doctest/doctest.h>

using namespace trundle::navigation;

namespace {

OccupancyTree tree_of(double resolution) { return OccupancyTree(TreeOptions{resolution, 0.85F, -0.4F, -2.0F, 3.5F}); }

}  // namespace

TEST_CASE("a ray along an axis frees each cube before its end") {
  OccupancyTree tree = tree_of(0.1);
  const std::vector<Point> hits{{-1.05, 0.05, 0.05}};
  REQUIRE(tree.insert({0.05, 0.05, 0.05}, hits, {}, -1.0));
  for (int i = 0; i < 11; ++i) CHECK(tree.odds({0.05 - 0.1 * i, 0.05, 0.05}) == -0.4F);
  CHECK(tree.odds({-1.05, 0.05, 0.05}) == 0.85F);
  CHECK(std::isnan(tree.odds({-1.15, 0.05, 0.05})));
}

TEST_CASE("a cube that one ray hits and another passes is hit") {
  OccupancyTree tree = tree_of(0.1);
  const std::vector<Point> hits{{1.05, 0.05, 0.05}, {2.05, 0.05, 0.05}};
  REQUIRE(tree.insert({0.05, 0.05, 0.05}, hits, {}, -1.0));
  CHECK(tree.odds({1.05, 0.05, 0.05}) == 0.85F);
  CHECK(tree.odds({0.55, 0.05, 0.05}) == -0.4F);  // once, not twice
}

TEST_CASE("rays that are not finite, or leave the tree, change nothing") {
  OccupancyTree tree = tree_of(0.1);
  const std::vector<Point> hits{{std::nan(""), 0.0, 0.0}, {1e300, 0.0, 0.0}, {0.0, 4000.0, 0.0}};
  CHECK(tree.insert({0.0, 0.0, 0.0}, hits, {}, -1.0));
  CHECK(tree.is_empty());
}

TEST_CASE("streams that are cut off, too deep or too large are refused") {
  OccupancyTree tree = tree_of(1.0);
  CHECK(tree.read_binary({}));
  const std::vector<std::uint8_t> endless(2 * 16, 3), whole{0xAA, 0xAA}, cut{3, 0};
  CHECK_FALSE(tree.read_binary(endless));
  CHECK_FALSE(tree.read_binary(whole));
  CHECK_FALSE(tree.read_binary(cut));
  const std::vector<std::uint8_t> deep(5 * 40, 1), nan{0, 0, 0xC0, 0x7F, 0};
  CHECK_FALSE(tree.read_full(deep, 5));
  CHECK_FALSE(tree.read_full(nan, 5));
}

TEST_CASE("a stream comes back with all cubes") {
  OccupancyTree tree = tree_of(0.1), again = tree_of(0.1), binary = tree_of(0.1);
  std::vector<Point> hits;
  for (int i = 0; i < 300; ++i) hits.push_back({2.0 * std::cos(i), 2.0 * std::sin(1.3 * i), 0.01 * i - 1.5});
  REQUIRE(tree.insert({0.0, 0.0, 0.0}, hits, {}, -1.0));
  REQUIRE(again.read_full(tree.full(), 5));
  REQUIRE(binary.read_binary(tree.binary()));
  CHECK(again.full() == tree.full());
  CHECK(binary.binary() == tree.binary());
  for (const Point& hit : hits) {
    CHECK(again.odds(hit) == tree.odds(hit));
    CHECK(binary.odds(hit) == 3.5F);
  }
}
