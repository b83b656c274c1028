// PID law of ros_control's controllers (control_toolbox).
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

namespace trundle {

struct ToolboxPid {
  double p = 0.0, i = 0.0, d = 0.0;
  double i_clamp = 0.0;     // limit of the integral term's magnitude
  bool antiwindup = false;  // the integral itself is clamped; else only its contribution
  double integral = 0.0, last = 0.0;

  void reset() { integral = last = 0.0; }

  // Command for error = desired - actual, dt [s] after the last; slope: derivative of the error [1/s]; without it,
  // the difference from the last error, which is 0 at first.
  double command(double error, double dt, std::optional<double> slope = {}) {
    if (dt <= 0.0) return 0.0;
    const double rate = slope.value_or((error - last) / dt);
    last = error;
    integral += error * dt;
    if (antiwindup && i != 0.0) {
      const double limit = std::abs(i_clamp / i);
      integral = std::min(std::max(integral, -limit), limit);
    }
    const double contribution = std::min(std::max(i * integral, -i_clamp), i_clamp);
    return p * error + contribution + d * rate;
  }
};

}  // namespace trundle
