// Elastic bands: bubbles, timed bands and their optimization, the system that it solves, bodies, and obstacles.
#include "navigation/band_obstacles.h"
#include "navigation/band_optimizer.h"
#include "navigation/banded_system.h"
#include "navigation/bubble_band.h"
#include "navigation/robot_body.h"
#include "navigation/timed_band.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

using namespace trundle;
using namespace trundle::navigation;

namespace {

std::vector<BandPose> straight(double length, int count) {
  std::vector<BandPose> path;
  for (int i = 0; i < count; ++i) path.push_back({length * i / (count - 1), 0.0, 0.0});
  return path;
}

// Least distance between a body and points along a band.
double clearance(const TimedBand& band, const RobotBody& body, const std::vector<Point>& points) {
  double least = 1e9;
  for (const BandPose& pose : band.poses)
    for (const Point& point : points) least = std::min(least, body.distance(pose, point).distance);
  return least;
}

RobotBody disc(double radius) { return {{{{0.0, 0.0}, {0.0, 0.0}, radius}}, false}; }

}  // namespace

TEST_CASE("a banded system has the solution of its equations") {
  constexpr std::size_t kSize = 12, kWidth = 3;
  BandedSystem system(kSize, kWidth);
  std::vector<double> wanted(kSize), right(kSize, 0.0);
  for (std::size_t i = 0; i < kSize; ++i) wanted[i] = std::sin(1.0 + static_cast<double>(i));
  for (std::size_t row = 0; row < kSize; ++row) {
    for (std::size_t column = row > kWidth ? row - kWidth : 0; column <= row; ++column) {
      const double entry = row == column ? 9.0 + static_cast<double>(row) : std::cos(static_cast<double>(row * column));
      system.at(row, column) = entry;
      right[row] += entry * wanted[column];
      if (row != column) right[column] += entry * wanted[row];
    }
  }

  std::vector<double> found;
  REQUIRE(system.solve(right, 0.0, found));
  for (std::size_t i = 0; i < kSize; ++i) CHECK(found[i] == doctest::Approx(wanted[i]));
  system.at(4, 4) = -50.0;
  CHECK_FALSE(system.solve(right, 0.0, found));
}

TEST_CASE("a body's distance is that of its outline, negative inside, and has exact slopes") {
  const RobotBody box({{{-0.2, -0.1}, {0.4, -0.1}, 0.0},
                       {{0.4, -0.1}, {0.4, 0.1}, 0.0},
                       {{0.4, 0.1}, {-0.2, 0.1}, 0.0},
                       {{-0.2, 0.1}, {-0.2, -0.1}, 0.0}},
                      true);
  CHECK(box.distance({1.0, 2.0, 0.0}, {1.9, 2.0}).distance == doctest::Approx(0.5));
  CHECK(box.distance({1.0, 2.0, std::acos(0.0)}, {1.0, 2.9}).distance == doctest::Approx(0.5));
  CHECK(box.distance({1.0, 2.0, 0.0}, {1.0, 2.0}).distance == doctest::Approx(-0.1));
  CHECK(box.reach() == doctest::Approx(std::hypot(0.4, 0.1)));
  CHECK(disc(0.3).distance({0.0, 0.0, 1.0}, {3.0, 4.0}).distance == doctest::Approx(4.7));

  const std::array<double, 3> pose{0.3, -0.2, 0.4};
  const Point point{1.1, 0.3};
  const BodyDistance found = box.distance(pose, point);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<double, 3> ahead = pose, behind = pose;
    ahead[axis] += 1e-6;
    behind[axis] -= 1e-6;
    const double slope = (box.distance(ahead, point).distance - box.distance(behind, point).distance) / 2e-6;
    CHECK(found.slope[axis] == doctest::Approx(slope).epsilon(1e-4));
  }
}

TEST_CASE("a resized band has steps near dt_ref, and its ends") {
  BandSettings settings;
  TimedBand band;
  band.set(straight(4.0, 5), settings);
  CHECK(band.poses.size() == band.steps.size() + 1);
  for (int round = 0; round < 10; ++round) band.resize(settings);

  CHECK(band.poses.size() == band.steps.size() + 1);
  CHECK(*std::max_element(band.steps.begin(), band.steps.end()) <= settings.dt_ref + settings.dt_hysteresis + 1e-9);
  CHECK(band.poses.front() == BandPose{0.0, 0.0, 0.0});
  CHECK(band.poses.back()[0] == doctest::Approx(4.0));

  band.move_ends({1.0, 0.1, 0.0}, {4.2, 0.0, 0.1});
  CHECK(band.poses.front() == BandPose{1.0, 0.1, 0.0});
  CHECK(band.poses.back() == BandPose{4.2, 0.0, 0.1});
  for (std::size_t i = 1; i < band.poses.size(); ++i) CHECK(band.poses[i][0] > band.poses[i - 1][0] - 1e-9);
}

TEST_CASE("an optimized band keeps its distance from an obstacle and the robot's limits") {
  BandSettings settings;
  settings.min_obstacle_dist = 0.2;
  settings.inflation_dist = 0.3;
  settings.penalty_epsilon = 0.1;
  settings.max_vel_theta = 1.0;
  const RobotBody body = disc(0.2);
  const std::vector<Point> obstacles{{2.0, 0.05}};
  TimedBand band;
  band.set(straight(4.0, 20), settings);
  const BandScene scene{body, obstacles, {}, {0.0, 0.0, 0.0}};
  double cost = 0.0;
  for (int round = 0; round < 20; ++round) cost = optimize_band(band, settings, scene, 1.0);

  CHECK(std::isfinite(cost));
  CHECK(clearance(band, body, obstacles) > 0.2);
  CHECK(band.poses.front() == BandPose{0.0, 0.0, 0.0});
  CHECK(band.poses.back()[0] == doctest::Approx(4.0));
  for (std::size_t i = 0; i < band.steps.size(); ++i) {
    const BandPose &a = band.poses[i], &b = band.poses[i + 1];
    CHECK(std::hypot(b[0] - a[0], b[1] - a[1]) / band.steps[i] < settings.max_vel_x * 1.1);
    CHECK(std::abs(angle_between(a[2], b[2])) / band.steps[i] < settings.max_vel_theta * 1.1);
  }
}

TEST_CASE("a band passes near its via points") {
  BandSettings settings;
  settings.weight_viapoint = 20.0;
  settings.max_vel_theta = 1.0;
  const RobotBody body = disc(0.2);
  const std::vector<Point> via{{2.0, 0.6}};
  TimedBand band;
  band.set(straight(4.0, 20), settings);
  for (int round = 0; round < 5; ++round) optimize_band(band, settings, {body, {}, via, {0.0, 0.0, 0.0}}, 1.0);

  CHECK(clearance(band, disc(0.0), via) < 0.2);
}

TEST_CASE("bubbles go around an obstacle, stay in free space, and overlap") {
  BubbleSettings settings;
  settings.robot_radius = 0.2;
  std::vector<Point> path, obstacles{{1.5, 0.1}};
  for (int i = 0; i <= 30; ++i) path.push_back({0.1 * i, -0.5 * std::exp(-std::pow((0.1 * i - 1.5) / 0.5, 2))});
  for (int i = 0; i <= 60; ++i) {
    obstacles.push_back({0.05 * i, -1.2});
    obstacles.push_back({0.05 * i, 1.2});
  }
  const std::vector<Bubble> bubbles = relax_bubbles(path, obstacles, settings);

  REQUIRE(bubbles.size() >= 2);
  CHECK(bubbles.front().center == path.front());
  CHECK(bubbles.back().center == path.back());
  for (std::size_t i = 0; i < bubbles.size(); ++i) {
    for (const Point& point : obstacles) {
      const double away = std::hypot(point[0] - bubbles[i].center[0], point[1] - bubbles[i].center[1]);
      CHECK(away >= bubbles[i].radius + settings.robot_radius - 1e-6);
    }
    if (i == 0) continue;
    const Bubble &a = bubbles[i - 1], &b = bubbles[i];
    CHECK(std::hypot(b.center[0] - a.center[0], b.center[1] - a.center[1]) <= a.radius + b.radius + 1e-6);
  }
}

TEST_CASE("no band leads through a gap that is too narrow") {
  BubbleSettings settings;
  settings.robot_radius = 0.2;
  const std::vector<Point> obstacles{{1.0, 0.15}, {1.0, -0.15}};
  CHECK(relax_bubbles({{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}}, obstacles, settings).empty());
}

TEST_CASE("an outline has the cells beside free ones; islands touch no edge") {
  const GridShape shape{12, 10};
  std::vector<std::uint8_t> costs(shape.size(), kFreeSpace);
  for (int y = 3; y < 7; ++y)
    for (int x = 3; x < 7; ++x) costs[shape.index(x, y)] = kLethalObstacle;
  for (int y = 0; y < 10; ++y) costs[shape.index(11, y)] = kLethalObstacle;

  const auto outline = obstacle_outline(costs.data(), shape);
  CHECK(outline.size() == 12 + 10);
  CHECK(std::find(outline.begin(), outline.end(), Point{4.0, 4.0}) == outline.end());
  CHECK(obstacle_islands(costs.data(), shape) == std::vector<Point>{{3.0, 3.0}});
}
