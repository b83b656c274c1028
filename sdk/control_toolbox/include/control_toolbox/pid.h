#pragma once

#include <ros/ros.h>

#include <mutex>
#include <string>

namespace control_toolbox {

/** Controller of an effort from an error: proportional, integral and derivative. */
class Pid {
 public:
  struct Gains {
    Gains(double p, double i, double d, double i_max, double i_min, bool antiwindup = false)
        : p_gain_(p), i_gain_(i), d_gain_(d), i_max_(i_max), i_min_(i_min), antiwindup_(antiwindup) {}
    Gains() : Gains(0.0, 0.0, 0.0, 0.0, 0.0) {}
    double p_gain_, i_gain_, d_gain_;
    /** Bounds of the integral term. */
    double i_max_, i_min_;
    /** True: the integral stops at the bounds, instead of its term. */
    bool antiwindup_;
  };

  explicit Pid(double p = 0.0, double i = 0.0, double d = 0.0, double i_max = 0.0, double i_min = -0.0,
               bool antiwindup = false);
  Pid(const Pid& source);
  Pid& operator=(const Pid& source);

  /** Set the gains, and forget past errors. */
  void initPid(double p, double i, double d, double i_max, double i_min, bool antiwindup = false);
  void initPid(double p, double i, double d, double i_max, double i_min, bool antiwindup, const ros::NodeHandle& node);
  /** Read the gains p, i, d, i_clamp (or i_clamp_min, i_clamp_max) and antiwindup; false if there is no p, i or d. */
  bool initParam(const std::string& prefix, const bool quiet = false);
  bool init(const ros::NodeHandle& node, const bool quiet = false);
  void reset();

  void getGains(double& p, double& i, double& d, double& i_max, double& i_min) const;
  void getGains(double& p, double& i, double& d, double& i_max, double& i_min, bool& antiwindup) const;
  Gains getGains() const;
  void setGains(double p, double i, double d, double i_max, double i_min, bool antiwindup = false);
  void setGains(const Gains& gains);

  /** Command for an error (target - state) after a time; by the error's slope, or by a derivative that is known. */
  double computeCommand(double error, ros::Duration dt);
  double computeCommand(double error, double error_dot, ros::Duration dt);

  void setCurrentCmd(double cmd) { cmd_ = cmd; }
  double getCurrentCmd() { return cmd_; }
  void getCurrentPIDErrors(double* pe, double* ie, double* de) const;
  void printValues() const;

 private:
  mutable std::mutex mutex_;
  Gains gains_;
  double p_error_last_ = 0.0, p_error_ = 0.0, i_error_ = 0.0, d_error_ = 0.0, cmd_ = 0.0;
};

}  // namespace control_toolbox
