// Laws of ros_control's controllers.
#include <limits>

#include <doctest/doctest.h>

#include "servo/drive_law.h"
#include "servo/toolbox_pid.h"

using namespace trundle;

TEST_CASE("a PID adds its three terms, with the slope of the error if it is passed") {
  ToolboxPid pid;
  pid.p = 2;
  pid.i = 1;
  pid.d = 0.5;
  pid.i_clamp = 10;
  CHECK(pid.command(1.0, 0.1) == doctest::Approx(2 + 0.1 + 0.5 * 10));
  CHECK(pid.command(1.0, 0.1) == doctest::Approx(2 + 0.2 + 0));
  CHECK(pid.command(1.0, 0.1, 4.0) == doctest::Approx(2 + 0.3 + 2));
  CHECK(pid.command(1.0, 0.0) == 0);
  pid.reset();
  CHECK(pid.integral == 0);
}

TEST_CASE("without antiwindup the contribution is clamped, and the integral keeps growing") {
  ToolboxPid pid;
  pid.i = 2;
  pid.i_clamp = 1;
  CHECK(pid.command(10.0, 1.0) == 1);
  CHECK(pid.integral == 10);
  CHECK(pid.command(-4.0, 1.0) == 1);
}

TEST_CASE("with antiwindup the integral is clamped, and leaves the limit at once") {
  ToolboxPid pid;
  pid.i = 2;
  pid.i_clamp = 1;
  pid.antiwindup = true;
  CHECK(pid.command(10.0, 1.0) == 1);
  CHECK(pid.integral == 0.5);
  CHECK(pid.command(-0.25, 1.0) == 0.5);
}

TEST_CASE("a speed changes by its largest acceleration and jerk, up to its largest speed") {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const SpeedLimit free{-kNone, kNone, -kNone, kNone, -kNone, kNone};
  CHECK(free.limit(7, 0, 0, 0.1) == 7);
  const SpeedLimit speed{-1, 2, -kNone, kNone, -kNone, kNone};
  CHECK(speed.limit(7, 0, 0, 0.1) == 2);
  CHECK(speed.limit(-7, 0, 0, 0.1) == -1);
  const SpeedLimit acceleration{-kNone, kNone, -4, 5, -kNone, kNone};
  CHECK(acceleration.limit(7, 1, 1, 0.1) == doctest::Approx(1.5));
  CHECK(acceleration.limit(-7, 1, 1, 0.1) == doctest::Approx(0.6));
  const SpeedLimit jerk{-kNone, kNone, -kNone, kNone, -50, 50};
  CHECK(jerk.limit(7, 1.0, 0.9, 0.1) == doctest::Approx(1.1 + 50 * 2 * 0.01));
}
