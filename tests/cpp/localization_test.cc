// Distances and rays in maps, the likelihood of scans, noise of odometry, particles, and motion between scans.
#include "navigation/cell_counts.h"
#include "navigation/grid_slam.h"
#include "navigation/hector_slam.h"
#include "navigation/laser_model.h"
#include "navigation/particle_filter.h"
#include "navigation/point_to_line_icp.h"
#include "navigation/pose_bins.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>

using namespace trundle::navigation;

namespace {

constexpr double kRange = 8.0;

// A room of 6 by 4 m with a pillar near (1.5, 2.5).
OccupancyMap room() {
  OccupancyMap map;
  map.width = 120;
  map.height = 80;
  map.cells.assign(120 * 80, 0);
  for (int row = 0; row < 80; ++row)
    for (int column = 0; column < 120; ++column) {
      const bool is_edge = row == 0 || column == 0 || row == 79 || column == 119;
      const bool is_pillar = column >= 28 && column < 34 && row >= 48 && row < 52;
      if (is_edge || is_pillar) map.cells[static_cast<std::size_t>(row * 120 + column)] = 100;
    }
  return map;
}

std::vector<double> bearings() {
  std::vector<double> angles;
  for (int i = 0; i < 180; ++i) angles.push_back(i * 2.0 * std::numbers::pi / 180.0);
  return angles;
}

LaserScan scan_at(const OccupancyMap& map, const PlanarPose& pose) {
  LaserScan scan;
  scan.range_max = kRange;
  scan.bearings = bearings();
  for (const double bearing : scan.bearings)
    scan.ranges.push_back(cast_ray(map, pose.x, pose.y, pose.yaw + bearing, kRange));
  return scan;
}

std::vector<ScanPoint> points_at(const OccupancyMap& map, const PlanarPose& pose) {
  const LaserScan scan = scan_at(map, pose);
  std::vector<ScanPoint> points;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i)
    points.push_back({scan.ranges[i] * std::cos(scan.bearings[i]), scan.ranges[i] * std::sin(scan.bearings[i])});
  return points;
}

double distance(const PlanarPose& a, const PlanarPose& b) { return std::hypot(a.x - b.x, a.y - b.y); }

}  // namespace

TEST_CASE("distances are exact up to their limit") {
  OccupancyMap map;
  map.width = map.height = 30;
  map.cells.assign(900, 0);
  map.cells[10 * 30 + 10] = 100;
  const auto found = distances_to_occupied(map, 0.5);

  CHECK(found[10 * 30 + 10] == 0.0f);
  CHECK(found[13 * 30 + 14] == doctest::Approx(0.25));
  CHECK(found[25 * 30 + 25] == doctest::Approx(0.5));
}

TEST_CASE("rays end at the first cell that is not free, or at the edge") {
  const OccupancyMap map = room();
  CHECK(cast_ray(map, 3.0, 2.0, 0.0, kRange) == doctest::Approx(2.95).epsilon(0.02));
  CHECK(cast_ray(map, 3.0, 2.5, std::numbers::pi, kRange) == doctest::Approx(1.3).epsilon(0.05));  // the pillar
  CHECK(cast_ray(map, 3.0, 2.0, 0.0, 1.0) == doctest::Approx(1.0));
}

TEST_CASE("a scan is most likely where it was taken, by every model") {
  const auto map = std::make_shared<const OccupancyMap>(room());
  const PlanarPose truth{3.0, 1.5, 0.4};
  const LaserScan scan = scan_at(*map, truth);
  for (const LaserKind kind : {LaserKind::kBeam, LaserKind::kLikelihoodField, LaserKind::kLikelihoodFieldProb}) {
    LaserOptions options;
    options.kind = kind;
    options.z_hit = 0.9;
    LaserModel model(options, map);
    std::vector<Particle> particles;
    for (const PlanarPose& error : {PlanarPose{}, PlanarPose{0.4, 0, 0}, PlanarPose{0, -0.4, 0}, PlanarPose{0, 0, 0.5}})
      particles.push_back({{truth.x + error.x, truth.y + error.y, truth.yaw + error.yaw}, 0.25});
    model.weigh(particles, scan, {});

    for (std::size_t i = 1; i < particles.size(); ++i) CHECK(particles[0].weight > particles[i].weight);
  }
}

TEST_CASE("odometry moves particles by its motion, and spreads them with it") {
  for (const OdometryKind kind : {OdometryKind::kDiff, OdometryKind::kOmni, OdometryKind::kDiffCorrected}) {
    OdometryModel model;
    model.kind = kind;
    model.alphas = {0.01, 0.01, 0.01, 0.01, 0.01};
    Random random(1);
    std::vector<Particle> particles(2000, Particle{{1.0, 1.0, std::numbers::pi / 2.0}, 1.0});
    model.move(particles, {5.0, 5.0, 0.0}, {5.6, 5.0, 0.3}, random);
    PlanarPose mean;
    double spread = 0.0;
    for (const Particle& particle : particles) {
      mean.x += particle.pose.x / 2000.0;
      mean.y += particle.pose.y / 2000.0;
      mean.yaw += particle.pose.yaw / 2000.0;
    }
    for (const Particle& particle : particles) spread += std::pow(particle.pose.y - mean.y, 2) / 2000.0;

    CHECK(mean.x == doctest::Approx(1.0).epsilon(0.03));
    CHECK(mean.y == doctest::Approx(1.6).epsilon(0.03));
    CHECK(mean.yaw == doctest::Approx(std::numbers::pi / 2.0 + 0.3).epsilon(0.03));
    CHECK(spread > 1e-7);
    CHECK(spread < 0.02);
  }
}

TEST_CASE("particles gather at the robot") {
  const auto map = std::make_shared<const OccupancyMap>(room());
  ParticleFilter filter(FilterOptions{}, map, 7);
  LaserOptions options;
  options.max_beams = 60;
  LaserModel model(options, map);
  filter.spread({2.8, 1.2, 0.2}, {0.1, 0, 0, 0, 0.1, 0, 0, 0, 0.05});
  PlanarPose robot{3.0, 1.5, 0.4};
  for (int step = 0; step < 12; ++step) {
    const PlanarPose next = compose(robot, {0.1, 0.0, 0.1});
    filter.move(OdometryModel{}, robot, next);
    robot = next;
    filter.weigh(model, scan_at(*map, robot));
    filter.resample();
  }
  const Estimate estimate = filter.estimate();

  CHECK(distance(estimate.pose, robot) < 0.06);
  CHECK(std::abs(angle_difference(estimate.pose.yaw, robot.yaw)) < 0.05);
  CHECK(estimate.covariance[0] < 0.02);
  CHECK(filter.particles().size() < 1000);
}

TEST_CASE("bins that touch are one cluster") {
  PoseBins bins;
  CHECK(bins.add({0.1, 0.1, 0.0}) == 0);
  CHECK(bins.add({0.2, 0.2, 0.01}) == 0);
  CHECK(bins.add({0.6, 0.1, 0.0}) == 1);
  CHECK(bins.add({5.0, 5.0, 1.0}) == 2);
  CHECK(bins.count() == 3);
  const auto clusters = bins.clusters();
  CHECK(clusters[0] == clusters[1]);
  CHECK(clusters[0] != clusters[2]);
}

TEST_CASE("copies of a grid share patches until one changes") {
  PatchMap<int> map(0.1);
  map.at(-70, 3) = 5;
  PatchMap<int> copy = map;
  copy.at(-70, 3) = 6;

  CHECK(*map.find(-70, 3) == 5);
  CHECK(*copy.find(-70, 3) == 6);
  CHECK(map.find(70, 3) == nullptr);
  CHECK(map.cell_of(-0.05) == -1);
  CHECK_FALSE(map.reaches(1e9));
}

TEST_CASE("cells count as occupied by the share of beams that end in them") {
  CellCounts counts(0.1);
  for (int i = 0; i < 4; ++i) counts.add({0.05, 0.05, 1.0, 0.0}, 1.0, true);
  for (int i = 0; i < 2; ++i) counts.add({0.05, 0.05, 1.0, 0.0}, 2.0, false);
  const auto cells = counts.draw({0, 0, 12, 1, 0.25});
  const auto strict = counts.draw({0, 0, 12, 1, 0.9});

  CHECK(cells[5] == 0);
  CHECK(cells[10] == 100);
  CHECK(strict[10] == 0);
  CHECK(counts.draw({0, 5, 1, 1, 0.25})[0] == -1);
}

TEST_CASE("the motion between two scans is found, with points and with lines") {
  const OccupancyMap map = room();
  const PlanarPose first{3.0, 1.5, 0.3}, motion{0.12, -0.05, 0.08};
  const auto reference = points_at(map, first), scan = points_at(map, compose(first, motion));
  IcpOptions options;
  options.max_iterations = 40;
  const IcpMatch lines = match_scans(reference, scan, {}, options);
  REQUIRE(lines.is_valid);
  CHECK(distance(lines.pose, motion) < 0.02);
  CHECK(std::abs(angle_difference(lines.pose.yaw, motion.yaw)) < 0.01);
  options.uses_lines = false;
  const IcpMatch points = match_scans(reference, scan, {}, options);
  CHECK(distance(points.pose, motion) < 0.04);
  CHECK_FALSE(match_scans({}, scan, {}, options).is_valid);
}

TEST_CASE("a grid is mapped though the odometry slips") {
  const OccupancyMap map = room();
  SlamOptions options;
  options.particles = 8;
  options.linear_update = options.angular_update = 0.1;
  const PlanarPose start{2.0, 1.2, 0.0};
  GridSlam slam(options, bearings(), {}, 3);
  PlanarPose robot = start, odometry;
  for (int step = 0; step < 30; ++step) {
    slam.process(odometry, step, scan_at(map, robot).ranges);
    robot = compose(robot, {0.08, 0.0, 0.05});
    odometry = compose(odometry, {0.085, 0.0, 0.045});
  }
  slam.process(odometry, 30.0, scan_at(map, robot).ranges);
  const PlanarPose truth = compose(inverse(start), robot);
  const double slipped = distance(odometry, truth);

  CHECK(slipped > 0.15);
  CHECK(distance(slam.pose(), truth) < 0.06);
  const SeenCells seen = slam.seen();
  const int width = seen.last_column - seen.first_column + 1, height = seen.last_row - seen.first_row + 1;
  CHECK(width == doctest::Approx(120).epsilon(0.06));
  CHECK(height == doctest::Approx(80).epsilon(0.08));
  const auto cells = slam.draw({seen.first_column, seen.first_row, width, height, 0.25});
  CHECK(std::count(cells.begin(), cells.end(), 0) > 0.9 * 118 * 78);
}

TEST_CASE("scans alone are followed") {
  const OccupancyMap map = room();
  HectorOptions options;
  options.resolution = 0.05;
  options.size = 256;
  options.update_distance = options.update_angle = 0.1;
  HectorSlam slam(options);
  const PlanarPose start{2.0, 1.2, 0.0};
  PlanarPose robot = start;
  for (int step = 0; step < 30; ++step) {
    std::vector<Point> ends;
    for (const ScanPoint& point : points_at(map, robot)) ends.push_back({point.x, point.y});
    slam.update(slam.pose(), {0.0, 0.0}, ends, false);
    robot = compose(robot, {0.04, 0.0, 0.02});
  }
  const PlanarPose truth = compose(inverse(start), compose(robot, inverse({0.04, 0.0, 0.02})));

  CHECK(distance(slam.pose(), truth) < 0.06);
  CHECK(slam.score() > 0.6);
  const auto cells = slam.cells();
  CHECK(std::count(cells.begin(), cells.end(), 100) > 200);
}
