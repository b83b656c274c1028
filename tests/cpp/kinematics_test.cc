// Chains, inverse kinematics and manipulability, against a planar arm of two links.
#include "planning/group_chain.h"
#include "planning/manipulability.h"
#include "planning/pose_solver.h"

#include <cmath>
#include <numbers>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

namespace trundle::planning {

namespace {

constexpr double kUpper = 0.5, kLower = 0.3;  // lengths of the links [m]
constexpr double kPi = std::numbers::pi;

// Two joints about z, and a third link at the end; the base is 1 m above the model's frame.
LinkTree two_links() {
  return LinkTree({{JointKind::kFixed, -1, -1, {{}, {0, 0, 1}}, {}},
                   {JointKind::kRevolute, 0, 0, {}, {0, 0, 1}},
                   {JointKind::kRevolute, 1, 1, {{}, {kUpper, 0, 0}}, {0, 0, 1}},
                   {JointKind::kFixed, 2, -1, {{}, {kLower, 0, 0}}, {}}});
}

std::vector<ChainColumn> columns(double limit) {
  return {{0, -limit, limit, true, true}, {1, -limit, limit, true, true}};
}

PoseSolver solver(double limit, PoseSolverOptions options) {
  return {group_chain(two_links(), 3, {}, columns(limit)).chain, options};
}

Rigid target(double first, double second) {
  return {rotation_about({0, 0, 1}, first + second),
          {kUpper * std::cos(first) + kLower * std::cos(first + second),
           kUpper * std::sin(first) + kLower * std::sin(first + second), 0.0}};
}

class ElbowCheck : public StateCheck {
 public:
  bool is_valid(const double* state) override {
    ++asked;
    return state[1] < 0.0;
  }
  int asked = 0;
};

}  // namespace

TEST_CASE("a chain begins at the link that holds its first joint") {
  const GroupChain group = group_chain(two_links(), 3, {}, columns(3.0));
  CHECK(group.base == 0);
  CHECK(group.is_base_fixed);
  CHECK(group.base_pose.p.z == 1.0);
  CHECK(group.chain.size() == 2);

  const double q[] = {0.4, 0.9};
  JointChain::Pose pose;
  group.chain.place(q, nullptr, pose);
  const Rigid expected = target(0.4, 0.9);
  CHECK(norm(pose.tip.p - expected.p) < 1e-15);
  CHECK(norm(rotation_vector(transpose(pose.tip.r) * expected.r)) < 1e-15);

  double rows[12];
  group.chain.jacobian(pose, rows);
  CHECK(rows[0] == doctest::Approx(-expected.p.y));
  CHECK(rows[2] == doctest::Approx(expected.p.x));
  CHECK(rows[1] == doctest::Approx(-kLower * std::sin(1.3)));
  CHECK(rows[10] == 1.0);
}

TEST_CASE("a variable that moves no tip has no chain") { CHECK_THROWS(group_chain(two_links(), 0, {}, columns(3.0))); }

TEST_CASE("a pose has one solution, a position two") {
  const std::vector<double> start{0.1, 0.1};
  const PoseSolution found = solver(3.0, {}).solve({target(-0.7, 1.1), start, 1000, {}, nullptr});
  REQUIRE(found.is_found);
  CHECK(found.columns[0] == doctest::Approx(-0.7));
  CHECK(found.columns[1] == doctest::Approx(1.1));

  ElbowCheck check;
  const PoseSolution other = solver(3.0, {.position_only = true}).solve({target(-0.7, 1.1), start, 1000, {}, &check});
  REQUIRE(other.is_found);
  CHECK(other.columns[1] == doctest::Approx(-1.1));
  CHECK(check.asked == other.refused + 1);
}

TEST_CASE("what limits or links do not reach is not found within the budget") {
  const std::vector<double> start{0.0, 0.0};
  for (const PoseSolution& found : {solver(1.0, {}).solve({target(0.2, 1.1), start, 500, {}, nullptr}),
                                    solver(3.0, {}).solve({{{}, {2.0, 0.0, 0.0}}, start, 500, {}, nullptr})}) {
    CHECK_FALSE(found.is_found);
    CHECK(found.iterations >= 500);
    CHECK(found.iterations < 600);
    CHECK(found.attempts > 1);
  }
  const std::vector<double> tolerances{0.1, 0.1};
  CHECK_FALSE(solver(3.0, {}).solve({target(0.2, 0.2), start, 500, tolerances, nullptr}).is_found);
  CHECK(solver(3.0, {}).solve({target(0.05, 0.05), start, 500, tolerances, nullptr}).is_found);
}

TEST_CASE("whole turns are taken off towards the start") {
  const std::vector<double> start{0.3 + 2.0 * kPi, 0.5};
  const PoseSolution found = solver(7.0, {}).solve({target(0.2, 0.6), start, 1000, {}, nullptr});
  REQUIRE(found.is_found);
  CHECK(found.columns[0] == doctest::Approx(0.2 + 2.0 * kPi));
}

TEST_CASE("threads that share a solver have its answer") {
  const PoseSolver shared = solver(3.0, {.position_only = true, .type = SolveType::kDistance});
  const std::vector<double> start{1.0, -0.5};
  const PoseRequest request{target(-0.7, 1.1), start, 2000, {}, nullptr};
  const PoseSolution expected = shared.solve(request);
  std::vector<PoseSolution> found(4);
  std::vector<std::thread> threads;
  for (PoseSolution& solution : found) threads.emplace_back([&] { solution = shared.solve(request); });
  for (std::thread& thread : threads) thread.join();
  for (const PoseSolution& solution : found) CHECK(solution.columns == expected.columns);
  CHECK(expected.columns[1] == doctest::Approx(-1.1));  // the nearer elbow
}

TEST_CASE("manipulability is the product of singular values") {
  const double rows[] = {3, 0, 0, 0, 2, 0};  // singular values 3 and 2
  const auto [volume, ratio] = manipulability(rows, 3, 2);
  CHECK(volume == doctest::Approx(6.0));
  CHECK(ratio == doctest::Approx(2.0 / 3.0));
  const double tall[] = {3, 0, 0, 2, 0, 0};
  CHECK(manipulability(tall, 2, 3).first == doctest::Approx(6.0));
  const double singular[] = {1, 1, 1, 1};
  CHECK(manipulability(singular, 2, 2).second == doctest::Approx(0.0).epsilon(1e-7));
}

}  // namespace trundle::planning
