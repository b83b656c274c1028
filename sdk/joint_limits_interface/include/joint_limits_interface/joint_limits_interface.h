#pragma once

#include <ros/duration.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <hardware_interface/internal/resource_manager.h>
#include <hardware_interface/joint_command_interface.h>
#include <joint_limits_interface/joint_limits.h>
#include <joint_limits_interface/joint_limits_interface_exception.h>

namespace joint_limits_interface {

namespace internal {

/** Value within bounds. */
template <class T>
T saturate(const T value, const T min_value, const T max_value) {
  return std::min(std::max(value, min_value), max_value);
}

}  // namespace internal

/** Limits the command of a joint; `enforceLimits` is called after the controllers and before the write. */
class JointLimitHandle {
 public:
  JointLimitHandle() {}
  JointLimitHandle(const hardware_interface::JointHandle& jh, const JointLimits& limits) : jh_(jh), limits_(limits) {}
  virtual ~JointLimitHandle() {}
  std::string getName() const { return jh_.getName(); }
  virtual void enforceLimits(const ros::Duration& period) = 0;
  /** Forget the last command. */
  virtual void reset() { last_ = std::numeric_limits<double>::quiet_NaN(); }

 protected:
  static constexpr double kInfinite = std::numeric_limits<double>::infinity();

  void require(bool has_limits, const char* what) const {
    if (!has_limits)
      throw JointLimitsInterfaceException("Cannot enforce limits for joint '" + getName() + "'. It has no " + what +
                                          " limits specification.");
  }
  double minPosition() const { return limits_.has_position_limits ? limits_.min_position : -kInfinite; }
  double maxPosition() const { return limits_.has_position_limits ? limits_.max_position : kInfinite; }
  double maxVelocity() const { return limits_.has_velocity_limits ? limits_.max_velocity : kInfinite; }
  /** Last command, or the joint's value before the first. */
  double last(double value) const { return std::isnan(last_) ? value : last_; }
  void set(double command) { jh_.setCommand(last_ = command); }

  hardware_interface::JointHandle jh_;
  JointLimits limits_;
  double last_ = std::numeric_limits<double>::quiet_NaN();
};

/** Handle with soft limits, too: within their bounds, the allowed speed falls with the distance. */
class JointSoftLimitsHandle : public JointLimitHandle {
 public:
  JointSoftLimitsHandle() {}
  JointSoftLimitsHandle(const hardware_interface::JointHandle& jh, const JointLimits& limits,
                        const SoftJointLimits& soft_limits)
      : JointLimitHandle(jh, limits), soft_limits_(soft_limits) {}

 protected:
  /** Speeds that are allowed at a position. */
  double minSpeed(double position) const {
    return internal::saturate(-soft_limits_.k_position * (position - soft_limits_.min_position), -maxVelocity(),
                              maxVelocity());
  }
  double maxSpeed(double position) const {
    return internal::saturate(-soft_limits_.k_position * (position - soft_limits_.max_position), -maxVelocity(),
                              maxVelocity());
  }

  SoftJointLimits soft_limits_;
};

/** Position, and the speed at which it may change. */
class PositionJointSaturationHandle : public JointLimitHandle {
 public:
  PositionJointSaturationHandle() {}
  PositionJointSaturationHandle(const hardware_interface::JointHandle& jh, const JointLimits& limits)
      : JointLimitHandle(jh, limits) {}
  void enforceLimits(const ros::Duration& period) override {
    const double step = maxVelocity() * period.toSec(), before = last(jh_.getPosition());
    double low = minPosition(), high = maxPosition();
    if (std::isfinite(step)) {
      low = std::max(before - step, low);
      high = std::min(before + step, high);
    }
    set(internal::saturate(jh_.getCommand(), low, high));
  }
};

class PositionJointSoftLimitsHandle : public JointSoftLimitsHandle {
 public:
  PositionJointSoftLimitsHandle() {}
  /** Throws JointLimitsInterfaceException without a limit of velocity. */
  PositionJointSoftLimitsHandle(const hardware_interface::JointHandle& jh, const JointLimits& limits,
                                const SoftJointLimits& soft_limits)
      : JointSoftLimitsHandle(jh, limits, soft_limits) {
    require(limits.has_velocity_limits, "velocity");
  }
  void enforceLimits(const ros::Duration& period) override {
    const double before = last(jh_.getPosition()), dt = period.toSec();
    const double slowest = limits_.has_position_limits ? minSpeed(before) : -maxVelocity();
    const double fastest = limits_.has_position_limits ? maxSpeed(before) : maxVelocity();
    const double low = std::max(before + slowest * dt, minPosition()),
                 high = std::min(before + fastest * dt, maxPosition());
    set(internal::saturate(jh_.getCommand(), low, high));
  }
};

/** Velocity, and the acceleration by which it may change. */
class VelocityJointSaturationHandle : public JointLimitHandle {
 public:
  VelocityJointSaturationHandle() {}
  /** Throws JointLimitsInterfaceException without a limit of velocity. */
  VelocityJointSaturationHandle(const hardware_interface::JointHandle& jh, const JointLimits& limits)
      : JointLimitHandle(jh, limits) {
    require(limits.has_velocity_limits, "velocity");
  }
  void enforceLimits(const ros::Duration& period) override {
    double low = -limits_.max_velocity, high = limits_.max_velocity;
    if (limits_.has_acceleration_limits) {
      const double change = limits_.max_acceleration * period.toSec(), before = last(jh_.getVelocity());
      low = std::max(before - change, low);
      high = std::min(before + change, high);
    }
    set(internal::saturate(jh_.getCommand(), low, high));
  }
};

class VelocityJointSoftLimitsHandle : public JointSoftLimitsHandle {
 public:
  VelocityJointSoftLimitsHandle() {}
  VelocityJointSoftLimitsHandle(const hardware_interface::JointHandle& jh, const JointLimits& limits,
                                const SoftJointLimits& soft_limits)
      : JointSoftLimitsHandle(jh, limits, soft_limits) {}
  void enforceLimits(const ros::Duration& period) override {
    double low = -maxVelocity(), high = maxVelocity();
    if (limits_.has_position_limits) {
      low = minSpeed(jh_.getPosition());
      high = maxSpeed(jh_.getPosition());
    }
    if (limits_.has_acceleration_limits) {
      const double change = limits_.max_acceleration * period.toSec(), velocity = jh_.getVelocity();
      low = std::max(velocity - change, low);
      high = std::min(velocity + change, high);
    }
    set(internal::saturate(jh_.getCommand(), low, high));
  }
};

/** Effort, which may not push a joint beyond its limits, or faster than allowed. */
class EffortJointSaturationHandle : public JointLimitHandle {
 public:
  EffortJointSaturationHandle() {}
  /** Throws JointLimitsInterfaceException without limits of velocity and effort. */
  EffortJointSaturationHandle(const hardware_interface::JointHandle& jh, const JointLimits& limits)
      : JointLimitHandle(jh, limits) {
    require(limits.has_velocity_limits, "velocity");
    require(limits.has_effort_limits, "effort");
  }
  void enforceLimits(const ros::Duration&) override {
    double low = -limits_.max_effort, high = limits_.max_effort;
    const double position = jh_.getPosition(), velocity = jh_.getVelocity();
    if (position < minPosition() || velocity < -maxVelocity()) low = 0.0;
    if (position > maxPosition() || velocity > maxVelocity()) high = 0.0;
    set(internal::saturate(jh_.getCommand(), low, high));
  }
};

class EffortJointSoftLimitsHandle : public JointSoftLimitsHandle {
 public:
  EffortJointSoftLimitsHandle() {}
  /** Throws JointLimitsInterfaceException without limits of velocity and effort. */
  EffortJointSoftLimitsHandle(const hardware_interface::JointHandle& jh, const JointLimits& limits,
                              const SoftJointLimits& soft_limits)
      : JointSoftLimitsHandle(jh, limits, soft_limits) {
    require(limits.has_velocity_limits, "velocity");
    require(limits.has_effort_limits, "effort");
  }
  void enforceLimits(const ros::Duration&) override {
    const double position = jh_.getPosition(), velocity = jh_.getVelocity(), most = limits_.max_effort;
    const double slowest = limits_.has_position_limits ? minSpeed(position) : -maxVelocity();
    const double fastest = limits_.has_position_limits ? maxSpeed(position) : maxVelocity();
    const double low = internal::saturate(-soft_limits_.k_velocity * (velocity - slowest), -most, most);
    const double high = internal::saturate(-soft_limits_.k_velocity * (velocity - fastest), -most, most);
    set(internal::saturate(jh_.getCommand(), low, high));
  }
};

/** Handles of one kind, which are enforced together. */
template <class HandleType>
class JointLimitsInterface : public hardware_interface::ResourceManager<HandleType> {
 public:
  /** Throws JointLimitsInterfaceException if there is none of this name. */
  HandleType getHandle(const std::string& name) {
    try {
      return this->hardware_interface::ResourceManager<HandleType>::getHandle(name);
    } catch (const std::logic_error& error) {
      throw JointLimitsInterfaceException(error.what());
    }
  }
  void enforceLimits(const ros::Duration& period) {
    for (auto& entry : this->resource_map_) entry.second.enforceLimits(period);
  }
  void reset() {
    for (auto& entry : this->resource_map_) entry.second.reset();
  }
};
class PositionJointSaturationInterface : public JointLimitsInterface<PositionJointSaturationHandle> {};
class PositionJointSoftLimitsInterface : public JointLimitsInterface<PositionJointSoftLimitsHandle> {};
class VelocityJointSaturationInterface : public JointLimitsInterface<VelocityJointSaturationHandle> {};
class VelocityJointSoftLimitsInterface : public JointLimitsInterface<VelocityJointSoftLimitsHandle> {};
class EffortJointSaturationInterface : public JointLimitsInterface<EffortJointSaturationHandle> {};
class EffortJointSoftLimitsInterface : public JointLimitsInterface<EffortJointSoftLimitsHandle> {};

}  // namespace joint_limits_interface
