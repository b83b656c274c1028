// Sparse systems of blocks, graphs of poses, and scans matched in a window.
#include "navigation/block_cholesky.h"
#include "navigation/correlative_matcher.h"
#include "navigation/pose_graph.h"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>

using namespace trundle::navigation;

namespace {

constexpr std::array<double, 6> kInformation{100.0, 0.0, 100.0, 0.0, 0.0, 400.0};

// Poses on a circle, the measured motions between them, and one that closes it.
PoseGraph circle(int count, double scale) {
  PoseGraph graph;
  const double turn = 2.0 * std::numbers::pi / count;
  const PlanarPose motion{1.0, 0.0, turn};
  PlanarPose pose;
  for (int i = 0; i < count; ++i) {
    graph.poses.push_back(pose);
    pose = compose(pose, {scale, 0.0, scale * turn});
    if (i > 0) graph.constraints.push_back({i - 1, i, motion, kInformation});
  }
  graph.constraints.push_back({count - 1, 0, motion, kInformation});
  return graph;
}

// A room of 4 by 3 m with a pillar, seen from a place in it, with a hit every 3 cm; no wall is where cells meet.
RangeScan room(const PlanarPose& robot) {
  RangeScan scan;
  const PlanarPose robot_from_map = inverse(robot);
  const Placement place(robot_from_map);
  const std::vector<std::array<double, 4>> walls{{-2.02, -1.53, 1.98, -1.53},
                                                 {1.98, -1.53, 1.98, 1.47},
                                                 {1.98, 1.47, -2.02, 1.47},
                                                 {-2.02, 1.47, -2.02, -1.53},
                                                 {1.02, 0.5, 1.02, 1.0}};
  for (const auto& [x0, y0, x1, y1] : walls) {
    const int count = static_cast<int>(std::hypot(x1 - x0, y1 - y0) / 0.03);
    for (int i = 0; i < count; ++i) {
      const double part = (i + 0.5) / count;
      scan.hits.push_back(place({x0 + part * (x1 - x0), y0 + part * (y1 - y0)}));
    }
  }
  find_normals(scan);
  return scan;
}

ScoreWindow window_of(const RangeScan& scan, double resolution) {
  ScoreWindow window({0.0, 0.0}, 4.0, resolution, 0.03);
  for (const Point& hit : scan.hits) window.add(hit);
  window.finish();
  return window;
}

}  // namespace

TEST_CASE("a sparse system of blocks is solved as the whole one") {
  // A ring of five with a chord: the product with the solution gives the right side.
  const std::vector<std::pair<int, int>> pairs{{0, 1}, {0, 4}, {1, 2}, {1, 3}, {2, 3}, {3, 4}};
  std::vector<Block> diagonal(5), beside(pairs.size());
  for (std::size_t i = 0; i < diagonal.size(); ++i)
    diagonal[i] = {9.0 + static_cast<double>(i), 1.0, 0.5, 1.0, 8.0, -0.3, 0.5, -0.3, 7.0};
  for (std::size_t k = 0; k < beside.size(); ++k)
    for (std::size_t i = 0; i < 9; ++i) beside[k][i] = 0.3 * std::sin(static_cast<double>(9 * k + i));
  const std::vector<Triple> right{{1, 2, 3}, {-1, 0, 4}, {0.5, 0, 0}, {2, -2, 1}, {0, 1, 0}};
  std::vector<Triple> x = right;

  REQUIRE(BlockCholesky(5, pairs).solve(diagonal, beside, x));

  std::vector<Triple> product(5, Triple{});
  const auto add = [&](std::size_t row, const Block& block, std::size_t column, bool is_transposed) {
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        product[row][i] += block[is_transposed ? 3 * j + i : 3 * i + j] * x[column][j];
  };
  for (std::size_t i = 0; i < 5; ++i) add(i, diagonal[i], i, false);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto i = static_cast<std::size_t>(pairs[k].first), j = static_cast<std::size_t>(pairs[k].second);
    add(i, beside[k], j, false);
    add(j, beside[k], i, true);
  }
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t k = 0; k < 3; ++k) CHECK(product[i][k] == doctest::Approx(right[i][k]));
}

TEST_CASE("a system that is not positive definite is refused") {
  std::vector<Triple> x(2, Triple{1, 1, 1});
  const Block unit{1, 0, 0, 0, 1, 0, 0, 0, 1}, large{5, 0, 0, 0, 5, 0, 0, 0, 5};
  CHECK_FALSE(BlockCholesky(2, {{0, 1}}).solve({unit, unit}, {large}, x));
  x = {{1, 1, 1}, {1, 1, 1}};
  CHECK_FALSE(BlockCholesky(2, {{0, 1}}).solve({{NAN, 0, 0, 0, 1, 0, 0, 0, 1}, unit}, {{}}, x));
}

TEST_CASE("a closed circle of exact motions is found from a start that is far off") {
  PoseGraph graph = circle(40, 0.8);
  CHECK(graph.error() > 100.0);
  CHECK(graph.optimize() == doctest::Approx(0.0).epsilon(1e-6));
  const PoseGraph exact = circle(40, 1.0);
  for (std::size_t i = 0; i < graph.poses.size(); ++i) {
    CHECK(graph.poses[i].x == doctest::Approx(exact.poses[i].x).epsilon(1e-4));
    CHECK(graph.poses[i].y == doctest::Approx(exact.poses[i].y).epsilon(1e-4));
    CHECK(std::abs(angle_difference(graph.poses[i].yaw, exact.poses[i].yaw)) < 1e-4);
  }
}

TEST_CASE("a loop moves each of equal motions by the same part") {
  PoseGraph graph;
  for (int i = 0; i <= 10; ++i) graph.poses.push_back({1.0 * i, 0.0, 0.0});
  for (int i = 0; i < 10; ++i) graph.constraints.push_back({i, i + 1, {1.0, 0.0, 0.0}, kInformation});
  graph.constraints.push_back({0, 10, {9.0, 0.0, 0.0}, {1e8, 0.0, 1e8, 0.0, 0.0, 1e8}});
  graph.optimize();
  for (int i = 0; i <= 10; ++i) CHECK(graph.poses[static_cast<std::size_t>(i)].x == doctest::Approx(0.9 * i));
}

TEST_CASE("what is known along one axis turns with it") {
  const auto m = turned({4.0, 0.0, 1.0, 2.0, 0.0, 9.0}, 0.5 * std::numbers::pi);
  CHECK(m[0] == doctest::Approx(1.0));
  CHECK(m[1] == doctest::Approx(0.0));
  CHECK(m[2] == doctest::Approx(4.0));
  CHECK(m[3] == doctest::Approx(0.0));
  CHECK(m[4] == doctest::Approx(2.0));
  CHECK(m[5] == doctest::Approx(9.0));
}

TEST_CASE("a scan is found in its room from 1 m and 15 degrees beside") {
  const PlanarPose truth{0.4, -0.3, 0.2};
  const ScoreWindow coarse = window_of(room({}), 0.05), fine = window_of(room({}), 0.01);
  const RangeScan scan = room(truth);
  SearchOptions options{1.5, 0.35, 0.0175};
  options.is_penalized = false;

  const ScanMatch found = search(coarse, scan, {1.2, 0.3, 0.45}, options);
  const ScanMatch match = refine(fine, scan, found.pose);

  CHECK(std::hypot(found.pose.x - truth.x, found.pose.y - truth.y) < 0.08);
  CHECK(match.pose.x == doctest::Approx(truth.x).epsilon(0.01));
  CHECK(match.pose.y == doctest::Approx(truth.y).epsilon(0.01));
  CHECK(std::abs(match.pose.yaw - truth.yaw) < 0.003);
  CHECK(match.response > 0.9);
  CHECK(match.information[0] > 1000.0);
}

TEST_CASE("branch and bound finds the best of all poses") {
  const RangeScan scan = room({0.05, -0.1, 0.07});
  const ScoreWindow window = window_of(room({}), 0.05);
  SearchOptions options{0.5, 0.14, 0.035};
  options.is_penalized = false;
  const ScanMatch found = search(window, scan, {}, options);
  double best = 0.0;
  for (int angle = -4; angle <= 4; ++angle)
    for (int i = -10; i <= 10; ++i)
      for (int j = -10; j <= 10; ++j) {
        SearchOptions one{0.0, 0.0, 0.0};
        one.is_penalized = false;
        best = std::max(best, search(window, scan, {0.05 * i, 0.05 * j, 0.035 * angle}, one).response);
      }
  CHECK(found.response == doctest::Approx(best).epsilon(0.02));
}

TEST_CASE("a straight wall tells nothing of the way along it") {
  RangeScan wall;
  for (int i = -50; i <= 50; ++i) wall.hits.push_back({0.04 * i, 1.003});
  find_normals(wall);
  ScoreWindow window({0.0, 0.0}, 3.0, 0.01, 0.03);
  for (const Point& hit : wall.hits) window.add(hit);
  window.finish();
  const ScanMatch match = refine(window, wall, {0.0, 0.02, 0.0});
  CHECK(match.pose.y == doctest::Approx(0.0).epsilon(0.003));
  CHECK(match.information[2] > 10000.0);
  CHECK(match.information[0] < 1.0);
}
