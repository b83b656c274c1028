// Geometry of contacts, the tables of pairs, and friction pyramids.
#include "contact/contact_geometry.h"

#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "contact/friction_pyramid.h"
#include "contact/law_tables.h"

namespace trundle {
MujocoApi mujoco;  // as the module defines it; without Python there is no library to bind
}  // namespace trundle

using namespace trundle;

namespace {

// A contact on the floor that two degrees of freedom slide along its tangents, with its rows of constraints.
struct Sliding {
  mjContact contact{};
  mjModel model{};
  mjData data{};
  std::vector<double> jacobian = {0, 0, 1, 0, 0, 1}, speeds = {0, 0, 0}, warmstart = {0, 0};

  Sliding() {
    mujoco.mj_isSparse = [](const mjModel*) -> int { return 0; };
    const double frame[9] = {0, 0, 1, 1, 0, 0, 0, 1, 0};
    std::copy(frame, frame + 9, contact.frame);
    contact.dim = 3;
    contact.solref[0] = 0.02;
    contact.solref[1] = 1;
    contact.solimp[1] = 0.95;
    model.nv = 2;
    model.opt.timestep = 0.001;
    data.ncon = 1;
    data.contact = &contact;
    data.efc_J = jacobian.data();
    data.efc_vel = speeds.data();
    data.qacc_warmstart = warmstart.data();
  }
  Sliding(const Sliding&) = delete;
};

}  // namespace

TEST_CASE("the cross product is right-handed, and zero has no direction") {
  double z[3];
  const double x[3] = {1, 0, 0}, y[3] = {0, 1, 0};
  cross(z, x, y);
  CHECK(z[2] == 1);
  double long_one[3] = {0, 3, 4}, zero[3] = {};
  CHECK(normalize(long_one) == 5);
  CHECK(long_one[1] == doctest::Approx(0.6));
  CHECK(normalize(zero) == 0);
}

TEST_CASE("a pair has one key in either order, and is found in a sorted table") {
  mjModel model{};
  model.ngeom = 10;
  const int pair[2] = {3, 7}, back[2] = {7, 3}, other[2] = {3, 8};
  CHECK(pair_key(&model, pair) == pair_key(&model, back));
  CHECK(pair_key(&model, pair) != pair_key(&model, other));
  const std::vector<RestitutionRow> rows = {{12, 0.1, 0}, {37, 0.5, 0}, {90, 0.9, 0}};
  const std::span<const RestitutionRow> table(rows);
  REQUIRE(find_pair(table, pair_key(&model, pair)) != nullptr);
  CHECK(find_pair(table, pair_key(&model, pair))->restitution == 0.5);
  CHECK(find_pair(table, 38) == nullptr);
  CHECK(find_pair(std::span<const RestitutionRow>(), 12) == nullptr);
}

TEST_CASE("tangents and their rows turn to a direction projected into the surface") {
  Sliding sliding;
  sliding.speeds = {0, 2, 1};
  sliding.data.efc_vel = sliding.speeds.data();
  const double along[3] = {3, 4, 12};
  REQUIRE(align_tangents(&sliding.model, &sliding.data, sliding.contact, along));
  const double expected[9] = {0, 0, 1, 0.6, 0.8, 0, -0.8, 0.6, 0};
  for (int i = 0; i < 9; ++i) CHECK(sliding.contact.frame[i] == doctest::Approx(expected[i]));
  CHECK(sliding.jacobian[2] == doctest::Approx(0.6));
  CHECK(sliding.jacobian[4] == doctest::Approx(-0.8));
  CHECK(sliding.speeds[1] == doctest::Approx(0.6 * 2 + 0.8 * 1));
  CHECK(sliding.speeds[2] == doctest::Approx(-0.8 * 2 + 0.6 * 1));
}

TEST_CASE("a direction along the normal has no tangent") {
  Sliding sliding;
  const double along[3] = {0, 0, 2};
  CHECK_FALSE(align_tangents(&sliding.model, &sliding.data, sliding.contact, along));
  CHECK(sliding.contact.frame[3] == 1);
}

TEST_CASE("only coefficients that differ, within bounds, make a pyramid") {
  mjContact contact{};
  contact.dim = 3;
  const auto has = [&](double first, double second) {
    contact.friction[0] = first;
    contact.friction[1] = second;
    return has_pyramid(contact);
  };
  CHECK(has(0.5, 0.2));
  CHECK_FALSE(has(0.5, 0.5));
  CHECK_FALSE(has(0.5, 0.0005));
  CHECK_FALSE(has(3.0, 0.5));
  contact.dim = 1;
  CHECK_FALSE(has(0.5, 0.2));
}

TEST_CASE("the ellipse of a pyramid passes through its corner, with the slip as its normal") {
  LawTables laws{};
  laws.crowd = true;
  const double slips[][2] = {{1.0, 0.5}, {0.2, 1.0}, {-0.7, 0.7}};
  for (const auto& slip : slips) {
    Sliding sliding;
    sliding.contact.friction[0] = 0.6;
    sliding.contact.friction[1] = 0.3;
    sliding.speeds = {0, slip[0], slip[1]};
    sliding.data.efc_vel = sliding.speeds.data();
    shape_pyramids(laws, &sliding.model, &sliding.data);
    const bool swapped = std::abs(0.3 * slip[1]) > std::abs(0.6 * slip[0]);
    const double a = sliding.contact.friction[swapped ? 1 : 0], b = sliding.contact.friction[swapped ? 0 : 1];
    const double x = 0.6 / a, y = 0.3 / b;
    CHECK(x * x + y * y == doctest::Approx(1.0));
    CHECK(x / a / (y / b) == doctest::Approx(std::abs(slip[0] / slip[1])));
  }
}
