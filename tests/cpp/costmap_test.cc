// Costs that spread, fronts and their descent, frontiers, voxels along rays, and trajectories that are scored.
#include "navigation/frontiers.h"
#include "navigation/inflation.h"
#include "navigation/rollout.h"
#include "navigation/voxel_rays.h"
#include "navigation/wave_front.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

using namespace trundle;

namespace {

constexpr GridShape kShape{40, 30};

// Free cells with walls around them.
std::vector<std::uint8_t> room() {
  std::vector<std::uint8_t> cells(kShape.size(), kFreeSpace);
  for (int y = 0; y < kShape.height; ++y)
    for (int x = 0; x < kShape.width; ++x)
      if (x == 0 || y == 0 || x == kShape.width - 1 || y == kShape.height - 1) cells[kShape.index(x, y)] = 254;
  return cells;
}

RolloutSettings settings(bool accelerates) { return {2.0, 0.025, 0.1, 0.0, {0.5, 0.0, 1.0}, accelerates, false}; }

}  // namespace

TEST_CASE("inflated costs are those of the exact distance, also to obstacles outside the window") {
  std::vector<std::uint8_t> cells(kShape.size(), kFreeSpace);
  cells[kShape.index(10, 10)] = kLethalObstacle;
  std::vector<std::uint8_t> costs{254};
  for (int square = 1; square <= 36; ++square) costs.push_back(static_cast<std::uint8_t>(200 - square));
  inflate(cells.data(), kShape, {12, 0, 40, 30}, costs, false);

  CHECK(cells[kShape.index(11, 10)] == kFreeSpace);  // outside the window
  CHECK(cells[kShape.index(13, 10)] == 200 - 9);
  CHECK(cells[kShape.index(14, 13)] == 200 - 25);
  CHECK(cells[kShape.index(16, 11)] == kFreeSpace);  // a squared distance of 37
}

TEST_CASE("unknown cells are inflated only by what is asked for") {
  std::vector<std::uint8_t> cells(kShape.size(), kNoInformation);
  cells[kShape.index(10, 10)] = kLethalObstacle;
  std::vector<std::uint8_t> again = cells;
  const std::vector<std::uint8_t> costs{254, 253, 253, 100, 100};
  inflate(cells.data(), kShape, {0, 0, 40, 30}, costs, false);
  inflate(again.data(), kShape, {0, 0, 40, 30}, costs, true);

  CHECK(cells[kShape.index(11, 10)] == 253);
  CHECK(cells[kShape.index(12, 10)] == kNoInformation);
  CHECK(again[kShape.index(12, 10)] == 100);
}

TEST_CASE("a front grows with the distance, and around a wall") {
  std::vector<float> costs(kShape.size(), 1.0F);
  const std::vector<float> free = WaveFront(costs.data(), kShape, {{{5, 15}}}, {-1, -1}).take();
  for (const auto& [x, y] : {std::pair{30, 15}, std::pair{25, 25}, std::pair{5, 28}})
    CHECK(free[kShape.index(x, y)] == doctest::Approx(std::hypot(x - 5, y - 15)).epsilon(0.05));

  for (int y = 0; y < 25; ++y) costs[kShape.index(20, y)] = -1.0F;
  const std::vector<float> around = WaveFront(costs.data(), kShape, {{{5, 15}}}, {-1, -1}).take();
  CHECK(around[kShape.index(20, 10)] >= kUnreached);
  CHECK(around[kShape.index(35, 15)] > free[kShape.index(35, 15)] + 5.0F);
  const auto path = descend(around.data(), kShape, {35, 15}, {5, 15});
  REQUIRE(!path.empty());
  double length = 0.0, top = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    length += std::hypot(path[i][0] - path[i - 1][0], path[i][1] - path[i - 1][1]);
    top = std::max(top, path[i][1]);
  }
  CHECK(top > 23.5);  // past the wall's end
  CHECK(length == doctest::Approx(2.0 * std::hypot(15.0, 10.0)).epsilon(0.08));
  CHECK(descend(around.data(), kShape, {20, 10}, {5, 15}).empty());
}

TEST_CASE("frontiers are what free cells reach, the nearest first") {
  auto cells = room();
  for (int y = 1; y < 29; ++y)
    for (int x = 30; x < 39; ++x) cells[kShape.index(x, y)] = kNoInformation;
  for (int x = 1; x < 5; ++x) cells[kShape.index(x, 1)] = kNoInformation;
  const auto found = find_frontiers(cells.data(), kShape, 10, 5);

  REQUIRE(found.size() == 4 + 28);
  CHECK(found.front().row == 1);
  CHECK(found.front().frontier == 0);
  CHECK(found.back().frontier == 1);
  CHECK(std::all_of(found.begin() + 4, found.end(), [](const FrontierCell& cell) { return cell.column == 30; }));
  for (int y = 1; y < 29; ++y) cells[kShape.index(29, y)] = kLethalObstacle;
  CHECK(find_frontiers(cells.data(), kShape, 10, 5).size() == 4);
  CHECK(find_frontiers(cells.data(), kShape, -1, 5).empty());
}

TEST_CASE("voxels along a ray are freed, and columns without an obstacle cost nothing") {
  std::vector<std::uint32_t> columns(kShape.size(), 0x00ff00ffU);  // eight occupied levels
  std::vector<std::uint8_t> costs(kShape.size(), kLethalObstacle);
  const VoxelColumns voxels{kShape, 8, columns.data(), costs.data(), 8, 0};
  clear_voxel_ray(voxels, {2.5, 5.5, 1.5}, {12.5, 5.5, 1.5});

  CHECK((columns[kShape.index(7, 5)] >> 16 & 0x2U) == 0U);
  CHECK((columns[kShape.index(7, 5)] >> 16 & 0x4U) != 0U);
  CHECK(columns[kShape.index(7, 6)] == 0x00ff00ffU);
  CHECK(costs[kShape.index(7, 5)] == kLethalObstacle);  // other levels are still occupied
  for (int level = 0; level < 8; ++level) clear_voxel_ray(voxels, {2.5, 5.5, level + 0.5}, {12.5, 5.5, level + 0.5});
  CHECK(costs[kShape.index(7, 5)] == kFreeSpace);
}

TEST_CASE("a trajectory ends where its velocity leads, and acceleration needs its time") {
  const Triple steady{0.5, 0.0, 0.0};
  const auto straight = roll_out(settings(false), {1.0, 1.0, 0.0}, {0.0, 0.0, 0.0}, steady);
  REQUIRE(!straight.empty());
  CHECK(straight.back()[0] == doctest::Approx(2.0).epsilon(0.03));

  const auto slow = roll_out(settings(true), {1.0, 1.0, 0.0}, {0.0, 0.0, 0.0}, steady);
  CHECK(slow.back()[0] == doctest::Approx(1.0 + 0.5 * 0.5 + 0.5).epsilon(0.05));  // 1 s at 0.5 m/s², then 1 s at 0.5

  const auto curve = roll_out(settings(false), {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, {0.5, 0.0, 0.5});
  CHECK(curve.back()[0] == doctest::Approx(std::sin(1.0)).epsilon(0.05));
  CHECK(curve.back()[1] == doctest::Approx(1.0 - std::cos(1.0)).epsilon(0.08));
  CHECK(curve.back()[2] == doctest::Approx(1.0).epsilon(0.03));
}

TEST_CASE("a footprint collides with what it touches, and may not leave the map") {
  auto cells = room();
  cells[kShape.index(20, 15)] = kLethalObstacle;
  std::vector<float> distance(kShape.size(), 1.0F);
  const RolloutMaps maps{kShape, {0.0, 0.0}, 0.1, cells.data(), distance.data(), distance.data(), distance.data()};
  const Polygon box{{0.25, 0.15}, {-0.25, 0.15}, {-0.25, -0.15}, {0.25, -0.15}};

  CHECK(footprint_cost(maps, box, {1.0, 1.0, 0.0}) == 0.0);
  CHECK(footprint_cost(maps, box, {1.82, 1.55, 0.0}) == -1.0);
  CHECK(footprint_cost(maps, box, {1.82, 1.55, 1.5708}) == 0.0);  // turned, its front does not reach it
  CHECK(footprint_cost(maps, box, {4.2, 1.0, 0.0}) == -2.0);

  FootprintCosts costs(maps, box);
  const auto toward = roll_out(settings(false), {1.2, 1.55, 0.0}, {0.0, 0.0, 0.0}, {0.5, 0.0, 0.0});
  CHECK(score_rollout(settings(false), costs, toward).obstacles < 0.0);
  const auto away = roll_out(settings(false), {1.2, 1.55, 3.14159}, {0.0, 0.0, 0.0}, {0.3, 0.0, 0.0});
  CHECK(score_rollout(settings(false), costs, away).obstacles == 0.0);
}
