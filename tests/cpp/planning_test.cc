// Kinematics, trees of boxes, constraints, spaces and times of arms.
#include "planning/blended_path.h"
#include "planning/box_tree.h"
#include "planning/convex_shape.h"
#include "planning/link_tree.h"
#include "planning/narrow_phase.h"
#include "planning/path_timing.h"
#include "planning/pose_constraint.h"
#include "planning/state_space.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>

using namespace trundle::planning;

namespace {

constexpr double kPi = std::numbers::pi;

// An arm of five joints of changing axes, 0.3 m apart; the last one slides.
LinkTree arm() {
  std::vector<TreeJoint> joints(6);
  const Vec3 axes[] = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int i = 0; i < 6; ++i) {
    TreeJoint& joint = joints[static_cast<std::size_t>(i)];
    joint.parent = i - 1;
    joint.origin.p = {0.05, 0.0, 0.3};
    if (i == 0) continue;
    joint.kind = i == 5 ? JointKind::kPrismatic : JointKind::kRevolute;
    joint.variable = i - 1;
    joint.axis = axes[i - 1];
  }
  return LinkTree(std::move(joints));
}

StateSpace arm_space() { return StateSpace(std::vector<Dimension>(5, {-2.0, 2.0, false, false})); }

const std::vector<int> kVariables{0, 1, 2, 3, 4};

PoseConstraint tool_constraint(OrientationError kind) {
  PoseConstraint constraint;
  constraint.link = 5;
  constraint.offset = {0.0, 0.02, 0.1};
  constraint.regions = {{std::make_shared<ConvexShape>(make_primitive(ShapeKind::kBox, {0.05, 0.1, 0.02})),
                         {rotation_about({0, 0, 1}, 0.4), {0.5, 0.2, 1.0}}}};
  constraint.orientation = kind;
  constraint.target = rotation_about({0, 1, 0}, 0.8);
  constraint.tolerance = {0.1, 0.2, 4.0};
  return constraint;
}

}  // namespace

TEST_CASE("a tree of boxes finds what overlaps, as a search of all does") {
  Random random(4);
  std::vector<Box> boxes(500);
  for (Box& box : boxes) {
    box.low = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    box.high = box.low + Vec3{random.uniform(0, 0.2), random.uniform(0, 0.2), random.uniform(0, 0.2)};
  }
  BoxTree tree;
  tree.build(boxes);
  for (const Box& wanted : boxes) {
    std::vector<int> found, expected;
    tree.query(wanted, [&](int item) {
      found.push_back(item);
      return true;
    });
    for (int i = 0; i < static_cast<int>(boxes.size()); ++i)
      if (boxes[static_cast<std::size_t>(i)].overlaps(wanted)) expected.push_back(i);
    std::sort(found.begin(), found.end());
    CHECK(found == expected);
  }
  BoxTree empty;
  empty.build({});
  CHECK(empty.query(boxes[0], [](int) { return false; }));
}

TEST_CASE("supports and nearest points of shapes") {
  const ConvexShape box = make_primitive(ShapeKind::kBox, {1.0, 2.0, 3.0});
  const ConvexShape hull = make_hull({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
  CHECK(box.support({-1, 1, -0.1}).y == doctest::Approx(2.0));
  CHECK(hull.support({1, 0.1, 0}).x == doctest::Approx(1.0));
  CHECK(norm(make_primitive(ShapeKind::kSphere, {0.5, 0, 0}).support({1, 2, 3})) == doctest::Approx(0.5));
  const Vec3 on_box = nearest_point(box, {3.0, 0.5, -9.0});
  CHECK(on_box.x == doctest::Approx(1.0));
  CHECK(on_box.z == doctest::Approx(-3.0));
  const Vec3 on_hull = nearest_point(hull, {1.0, 1.0, 1.0});  // the slanted face is at x + y + z = 1
  CHECK(on_hull.x + on_hull.y + on_hull.z == doctest::Approx(1.0).epsilon(0.01));
  CHECK(norm(nearest_point(hull, {0.1, 0.2, 0.1}) - Vec3{0.1, 0.2, 0.1}) < 1e-5);
}

TEST_CASE("a plane is cut by a box, or away from it") {
  const ConvexShape box = make_primitive(ShapeKind::kBox, {0.1, 0.1, 0.1});
  const Rigid plane{{}, {0, 0, 1.0}};
  CHECK(plane_distance(plane, box, {{}, {5, 5, 1.3}}, nullptr, nullptr) == doctest::Approx(0.2));
  CHECK(plane_distance(plane, box, {{}, {5, 5, 0.6}}, nullptr, nullptr) == doctest::Approx(0.3));
  CHECK(plane_distance(plane, box, {{}, {5, 5, 1.05}}, nullptr, nullptr) == doctest::Approx(-0.05));
}

TEST_CASE("the motion of a point is the difference of its places") {
  const LinkTree tree = arm();
  const State state{0.3, -0.7, 0.4, 1.1, 0.2};
  const Vec3 offset{0.1, 0.0, 0.2};
  std::vector<Rigid> poses, moved;
  tree.compute(state, poses);
  for (int k = 0; k < 5; ++k) {
    State other = state;
    other[static_cast<std::size_t>(k)] += 1e-6;
    tree.compute(other, moved);
    Vec3 linear, angular;
    tree.motion_of(5, poses[5] * offset, k, poses, linear, angular);
    const Vec3 difference = 1e6 * (moved[5] * offset - poses[5] * offset);
    CHECK(norm(difference - linear) < 1e-5);
    CHECK(norm(1e6 * rotation_vector(moved[5].r * transpose(poses[5].r)) - angular) < 1e-4);
  }
  CHECK(tree.is_below(5, 2));
  CHECK(!tree.is_below(2, 5));
}

TEST_CASE("the gradient of a constraint is the difference of its violations") {
  const LinkTree tree = arm();
  for (const OrientationError kind : {OrientationError::kEuler, OrientationError::kRotationVector}) {
    PoseConstraint constraint = tool_constraint(kind);
    if (kind == OrientationError::kRotationVector) constraint.target = rotation_about({0, 0, 1}, 0.1);
    const State state =
        kind == OrientationError::kEuler ? State{0.3, -0.4, 0.4, 0.6, 0.2} : State{0.1, 0.2, 0.1, 0.1, 0};
    std::vector<Rigid> poses;
    tree.compute(state, poses);
    Violation at, beside;
    measure(constraint, tree, poses, kVariables, at, true);
    REQUIRE(at.residuals.size() == 6);
    for (std::size_t k = 0; k < 5; ++k) {
      State other = state;
      other[k] += 1e-6;
      tree.compute(other, poses);
      measure(constraint, tree, poses, kVariables, beside, false);
      for (std::size_t row = 0; row < 6; ++row) {
        if (row < 3 || at.residuals[row] == 0.0) continue;  // a position's gradient is that of a point, not of a region
        CHECK(std::abs(1e6 * (beside.residuals[row] - at.residuals[row]) - at.gradient[5 * row + k]) < 1e-4);
      }
    }
  }
}

TEST_CASE("a projected state satisfies its constraints within the limits") {
  const LinkTree tree = arm();
  const StateSpace space = arm_space();
  Projection projection(tree, space, kVariables);
  const PoseConstraint constraint = tool_constraint(OrientationError::kEuler);
  Random random(2);
  int count = 0;
  for (int i = 0; i < 50; ++i) {
    State group(5), state(5);
    space.sample(random, group);
    if (!projection.project({&constraint, 1}, state, group, 100)) continue;
    ++count;
    std::vector<Rigid> poses;
    tree.compute(group, poses);
    CHECK(is_satisfied(constraint, poses, 1e-5));
    CHECK(space.is_within(group, 1e-9));
  }
  CHECK(count > 25);
}

TEST_CASE("circles go the short way, quaternions along the sphere") {
  const StateSpace space({{-kPi, kPi, true, false}, {0.0, 2.0, false, false}});
  State middle(2);
  space.interpolate(State{3.0, 0.0}, State{-3.0, 1.0}, 0.5, middle);
  CHECK(std::abs(middle[0]) == doctest::Approx(kPi));
  CHECK(middle[1] == doctest::Approx(0.5));
  CHECK(space.distance(State{3.0, 0.0}, State{-3.0, 0.0}) == doctest::Approx(2.0 * kPi - 6.0));
  const StateSpace turns({{-1, 1, false, true}, {-1, 1}, {-1, 1}, {-1, 1}});
  State turn(4);
  turns.interpolate(State{0, 0, 0, 1}, State{0, 0, -1, 0}, 0.5, turn);
  CHECK(turns.distance(State{0, 0, 0, 1}, turn) == doctest::Approx(kPi / 4));
  CHECK(turns.distance(State{0, 0, 0, 1}, State{0, 0, 0, -1}) == doctest::Approx(0.0));
}

TEST_CASE("arcs leave corners by the tolerance, and lines join them smoothly") {
  const std::vector<State> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 2}};
  const BlendedPath path(corners, 0.05);
  double nearest = 1e9;
  State before, tangent, last, curvature, point;
  for (double s = 0.0; s <= path.length(); s += 1e-3) {
    path.evaluate(path.part_at(s), s, point, tangent, curvature);
    if (!last.empty()) {
      double turn = 0.0, step = 0.0;
      for (std::size_t i = 0; i < 3; ++i) {
        turn += (tangent[i] - last[i]) * (tangent[i] - last[i]);
        step += (point[i] - before[i]) * (point[i] - before[i]);
      }
      CHECK(std::sqrt(turn) < 0.02);
      CHECK(std::sqrt(step) == doctest::Approx(1e-3).epsilon(0.01));
    }
    last = tangent;
    before = point;
    nearest = std::min(nearest, std::hypot(point[0] - 1.0, point[1], point[2]));
  }
  CHECK(nearest == doctest::Approx(0.05).epsilon(0.01));
  CHECK(path.length() < 4.0);
}

TEST_CASE("times along a path keep every limit and end at rest") {
  Random random(6);
  for (int i = 0; i < 20; ++i) {
    std::vector<State> waypoints(6, State(3));
    for (State& waypoint : waypoints)
      for (double& value : waypoint) value = random.uniform(-1, 1);
    const MotionLimits limits{{1.0, 0.5, 2.0}, {2.0, 1.0, 0.7}};
    for (const bool is_optimal : {true, false}) {
      const TimedStates timed =
          is_optimal ? time_optimal(BlendedPath(waypoints, 0.05), limits, 0.02) : time_parabolic(waypoints, limits);
      REQUIRE(timed.times.size() > 2);
      for (std::size_t k = 0; k < timed.times.size(); ++k)
        for (std::size_t j = 0; j < 3; ++j) {
          CHECK(std::abs(timed.velocities[k][j]) <= limits.velocity[j] * (1.0 + 1e-9));
          CHECK(std::abs(timed.accelerations[k][j]) <= limits.acceleration[j] * (1.0 + 1e-9));
        }
      CHECK(timed.positions.back()[1] == doctest::Approx(waypoints.back()[1]));
      CHECK(timed.velocities.back() == State(3, 0.0));
    }
  }
}
