#include "control_toolbox/pid.h"

#include <algorithm>
#include <cmath>

namespace control_toolbox {
namespace {

double clamped(double value, double low, double high) { return std::max(low, std::min(value, high)); }

}  // namespace

Pid::Pid(double p, double i, double d, double i_max, double i_min, bool antiwindup)
    : gains_(p, i, d, i_max, i_min, antiwindup) {}

Pid::Pid(const Pid& source) : gains_(source.getGains()) {}

Pid& Pid::operator=(const Pid& source) {
  if (this == &source) return *this;
  setGains(source.getGains());
  reset();
  return *this;
}

void Pid::initPid(double p, double i, double d, double i_max, double i_min, bool antiwindup) {
  setGains(p, i, d, i_max, i_min, antiwindup);
  reset();
}

void Pid::initPid(double p, double i, double d, double i_max, double i_min, bool antiwindup, const ros::NodeHandle&) {
  initPid(p, i, d, i_max, i_min, antiwindup);
}

bool Pid::initParam(const std::string& prefix, const bool quiet) { return init(ros::NodeHandle(prefix), quiet); }

bool Pid::init(const ros::NodeHandle& node, const bool quiet) {
  Gains gains;
  if (!node.getParam("p", gains.p_gain_)) {
    if (!quiet) ROS_ERROR("No p gain specified for pid.  Namespace: %s", node.getNamespace().c_str());
    return false;
  }
  node.param("i", gains.i_gain_, 0.0);
  node.param("d", gains.d_gain_, 0.0);
  double clamp = 0.0;
  node.param("i_clamp", clamp, 0.0);
  gains.i_max_ = std::fabs(clamp);
  gains.i_min_ = -std::fabs(clamp);
  if (node.hasParam("i_clamp_min")) node.getParam("i_clamp_min", gains.i_min_);
  if (node.hasParam("i_clamp_max")) node.getParam("i_clamp_max", gains.i_max_);
  gains.i_min_ = -std::fabs(gains.i_min_);
  gains.i_max_ = std::fabs(gains.i_max_);
  node.param("antiwindup", gains.antiwindup_, false);
  setGains(gains);
  reset();
  return true;
}

void Pid::reset() {
  const std::lock_guard<std::mutex> lock(mutex_);
  p_error_last_ = p_error_ = i_error_ = d_error_ = cmd_ = 0.0;
}

void Pid::getGains(double& p, double& i, double& d, double& i_max, double& i_min) const {
  bool antiwindup = false;
  getGains(p, i, d, i_max, i_min, antiwindup);
}

void Pid::getGains(double& p, double& i, double& d, double& i_max, double& i_min, bool& antiwindup) const {
  const Gains gains = getGains();
  p = gains.p_gain_;
  i = gains.i_gain_;
  d = gains.d_gain_;
  i_max = gains.i_max_;
  i_min = gains.i_min_;
  antiwindup = gains.antiwindup_;
}

Pid::Gains Pid::getGains() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return gains_;
}

void Pid::setGains(double p, double i, double d, double i_max, double i_min, bool antiwindup) {
  setGains(Gains(p, i, d, i_max, i_min, antiwindup));
}

void Pid::setGains(const Gains& gains) {
  const std::lock_guard<std::mutex> lock(mutex_);
  gains_ = gains;
}

double Pid::computeCommand(double error, ros::Duration dt) {
  if (dt.isZero() || !std::isfinite(error)) return 0.0;
  double slope = d_error_;
  if (dt.toSec() > 0.0) {
    slope = (error - p_error_last_) / dt.toSec();
    p_error_last_ = error;
  }
  return computeCommand(error, slope, dt);
}

double Pid::computeCommand(double error, double error_dot, ros::Duration dt) {
  const Gains gains = getGains();
  p_error_ = error;
  d_error_ = error_dot;
  if (dt.isZero() || !std::isfinite(error) || !std::isfinite(error_dot)) return 0.0;
  i_error_ += dt.toSec() * p_error_;
  if (gains.antiwindup_ && gains.i_gain_ != 0.0) {
    const double a = gains.i_min_ / std::fabs(gains.i_gain_), b = gains.i_max_ / std::fabs(gains.i_gain_);
    i_error_ = clamped(i_error_, a, b);
  }
  const double i_term = clamped(gains.i_gain_ * i_error_, gains.i_min_, gains.i_max_);
  cmd_ = gains.p_gain_ * p_error_ + i_term + gains.d_gain_ * d_error_;
  return cmd_;
}

void Pid::getCurrentPIDErrors(double* pe, double* ie, double* de) const {
  *pe = p_error_;
  *ie = i_error_;
  *de = d_error_;
}

void Pid::printValues() const {
  const Gains gains = getGains();
  ROS_INFO(
      "Current Values of PID Class:\n  P Gain: %g\n  I Gain: %g\n  D Gain: %g\n  I_Max:  %g\n  I_Min:  %g\n"
      "  Antiwindup: %d\n  P_Error: %g\n  I_Error: %g\n  D_Error: %g\n  Command: %g",
      gains.p_gain_, gains.i_gain_, gains.d_gain_, gains.i_max_, gains.i_min_, gains.antiwindup_, p_error_, i_error_,
      d_error_, cmd_);
}

}  // namespace control_toolbox
